#include "make_reply.hpp"

#include <algorithm>
#include <sstream>

namespace graspd::server {
namespace {

PlanReply make_reply(const IncomingRequest& to, PlanStatus status, std::string message) {
    PlanReply reply;
    reply.request_id = to.identity().request_id;
    reply.frame_id = to.frame_id();
    reply.status = status;
    reply.message = std::move(message);
    return reply;
}

}  // namespace

PlanReply overloaded(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kOverloaded, "the queue is full; send the request again");
}

PlanReply cancelled(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kCancelled, "cancelled by its client");
}

PlanReply stopped(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kCancelled, "graspd is stopping");
}

PlanReply id_clash(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kInvalidRequest,
                      "request_id = " + to.identity().request_id +
                          " was used by this writer for a request with other contents");
}

PlanReply unknown_object(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kUnknownObject,
                      "object_key = " + to.object_key() +
                          " is unknown or no longer kept; send the object itself");
}

PlanReply budget_spent(const IncomingRequest& to, const PlanOptions& options) {
    std::ostringstream text;
    text << "time_budget = " << options.time_budget_s << " s was over before planning began";
    return make_reply(to, PlanStatus::kPartial, text.str());
}

PlanReply internal_error(const IncomingRequest& to, const std::string& what) {
    return make_reply(to, PlanStatus::kInternalError,
                      "planning failed by a fault of ours: " + what);
}

PlanReply refused(const IncomingRequest& to, const PlanError& error) {
    return make_reply(to, status_of(error.code), error.detail);
}

std::chrono::steady_clock::time_point deadline_of(const IncomingRequest& request,
                                                  const PlanOptions& options) {
    using Clock = std::chrono::steady_clock;
    constexpr double kYear_s = 3.2e7;  // keeps the sum below far from the clock's end
    const std::chrono::duration<double> budget(std::min(options.time_budget_s, kYear_s));
    return request.received() + std::chrono::duration_cast<Clock::duration>(budget);
}

std::size_t point_count(const std::variant<TriangleMesh, PointCloud>& object) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&object)) return mesh->vertices.size();
    return std::get<PointCloud>(object).points.size();
}

}  // namespace graspd::server
