#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graspd/base/result.hpp"
#include "rejections.hpp"
#include "stage_log.hpp"

namespace graspd::planner_detail {

/// What was found within the limits of one request.
struct Found {
    std::vector<Grasp> grasps;                            ///< best first, in F
    Rejections rejections;                                ///< poses of misses in P
    std::vector<std::vector<TracedBoundary>> boundaries;  ///< one a gripper, where traced
    std::optional<Stopped> stopped;                       ///< the caller wanted no more
};

/// The reply under construction.
struct Answer {
    PlanReply reply;
    StageLog log;

    explicit Answer(const PlanRequest& request);
    /// The reply to a request that cannot be planned for.
    PlanReply refuse(const PlanError& error);
    /// Grasps, rejections, status and message. @param X_FP  to say the misses in F
    void conclude(Found found, const Eigen::Isometry3d& X_FP);
    /// The reply when the caller wants no more: PARTIAL, with what conclude() has put in.
    PlanReply stop(const Stopped& stopped);
    PlanReply finish();
};

}  // namespace graspd::planner_detail
