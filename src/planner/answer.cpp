#include "answer.hpp"

#include <algorithm>

namespace graspd::planner_detail {
namespace {

std::string strategy_of(const std::vector<Grasp>& grasps) {
    if (grasps.empty()) return "";
    if (grasps.front().source == kCandidate) return "candidates";
    const auto whole = std::ranges::count(grasps, kWholeObject, &Grasp::source);
    if (whole == 0) return "concavity";
    return whole == std::ssize(grasps) ? "whole_object" : "mixed";
}

std::string why_none(const std::vector<RejectionCount>& rejections) {
    if (rejections.empty()) return "no candidate was found";
    std::uint64_t all = 0;
    for (const RejectionCount& row : rejections) all += row.count;
    return "none of " + std::to_string(all) + " candidates holds and is free; most fell by " +
           rejections.front().reason + " (" + std::to_string(rejections.front().count) + ")";
}

}  // namespace

Answer::Answer(const PlanRequest& request) {
    reply.request_id = request.request_id;
    reply.frame_id = request.frame_id;
}

PlanReply Answer::refuse(const PlanError& error) {
    reply.status = status_of(error.code);
    reply.message = error.detail;
    return finish();
}

void Answer::conclude(Found found, const Eigen::Isometry3d& X_FP) {
    reply.grasps = std::move(found.grasps);
    reply.strategy = strategy_of(reply.grasps);
    reply.report.rejections = found.rejections.counts();
    reply.report.near_misses = found.rejections.misses();
    for (NearMiss& miss : reply.report.near_misses) miss.X_FG = X_FP * miss.X_FG;
    if (reply.grasps.empty()) {
        reply.status = PlanStatus::kNoGrasp;
        reply.message = why_none(reply.report.rejections);
    } else {
        reply.status = PlanStatus::kOk;
    }
}

PlanReply Answer::stop(const Stopped& stopped) {
    const std::string where = stopped.where == nullptr ? "between two stages" : stopped.where;
    reply.status = PlanStatus::kPartial;
    reply.message = "stopped in " + where +
                    (reply.grasps.empty() ? "; the rounds that were done, if any, gave no grasp"
                                          : "; the best of the rounds that were done");
    return finish();
}

PlanReply Answer::finish() {
    reply.report.stages = log.take();
    return std::move(reply);
}

}  // namespace graspd::planner_detail
