#include "make_reply.hpp"

#include <algorithm>
#include <sstream>

namespace graspd::server {
namespace {

// What the stages hold at a time, added up by the sizes of their arrays. Most of a vertex's share
// is qhull's, for objects whose vertices all lie on the hull; budget_bench --peak shows real ones.
constexpr std::uint64_t kVertex_bytes = 1200;
constexpr std::uint64_t kFace_bytes = 400;
constexpr std::uint64_t kPoint_bytes = 200;
constexpr std::uint64_t kObstacleVertex_bytes = 100;
constexpr std::uint64_t kObstacleFace_bytes = 250;

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

PlanReply no_markers(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kInvalidRequest,
                      "options[0].markers = true, but server.markers = never");
}

std::string budget_text(const IncomingRequest& request) {
    std::ostringstream text;
    text << "time_budget = " << request.time_budget_s() << " s";
    return text.str();
}

PlanReply budget_spent(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kPartial,
                      budget_text(to) + " was over before planning began");
}

PlanReply overran(const IncomingRequest& to) {
    return make_reply(to, PlanStatus::kPartial,
                      budget_text(to) + " is over and planning has not stopped; it is abandoned");
}

PlanReply too_large(const IncomingRequest& to, std::uint64_t needed, std::uint64_t limit) {
    const RequestSize& size = to.size();
    std::ostringstream text;
    text << "mesh.vertices = " << size.vertices << ", mesh.triangles = " << size.faces
         << ", cloud points = " << size.points
         << ", vertices of obstacles = " << size.obstacle_vertices
         << " and their triangles = " << size.obstacle_faces << " would take " << needed
         << " bytes, limit server.max_memory_bytes = " << limit;
    return make_reply(to, PlanStatus::kInvalidRequest, text.str());
}

PlanReply internal_error(const IncomingRequest& to, const std::string& what) {
    return make_reply(to, PlanStatus::kInternalError,
                      "planning failed by a fault of ours: " + what);
}

PlanReply refused(const IncomingRequest& to, const PlanError& error) {
    return make_reply(to, status_of(error.code), error.detail);
}

std::chrono::steady_clock::time_point deadline_of(const IncomingRequest& request) {
    using Clock = std::chrono::steady_clock;
    constexpr double kYear_s = 3.2e7;  // keeps the sum below far from the clock's end
    const std::chrono::duration<double> budget(std::min(request.time_budget_s(), kYear_s));
    return request.received() + std::chrono::duration_cast<Clock::duration>(budget);
}

std::uint64_t needed_bytes(const RequestSize& size) {
    return kVertex_bytes * size.vertices + kFace_bytes * size.faces + kPoint_bytes * size.points +
           kObstacleVertex_bytes * size.obstacle_vertices +
           kObstacleFace_bytes * size.obstacle_faces;
}

std::size_t point_count(const std::variant<TriangleMesh, PointCloud>& object) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&object)) return mesh->vertices.size();
    return std::get<PointCloud>(object).points.size();
}

}  // namespace graspd::server
