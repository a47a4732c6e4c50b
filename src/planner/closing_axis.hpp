#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Geometry>

#include "graspd/planner/plan_trace.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::planner_detail {

/// How a hand comes to a closing axis.
struct ApproachPose {
    double turn_rad = 0.0;  ///< [rad] about Gx, from the reference direction
    double deeper_m = 0.0;  ///< [m] along Gz
};

/// A line that a hand could close along, from whichever source. Frame P throughout.
struct ClosingAxis {
    Eigen::Vector3d left_P = Eigen::Vector3d::Zero();       ///< [m] place at -Gx
    Eigen::Vector3d right_P = Eigen::Vector3d::Zero();      ///< [m] place at +Gx
    Eigen::Vector3d reference_P = Eigen::Vector3d::Zero();  ///< unit: the first approach direction,
                                                            ///< at right angles to left-right
    GraspSource source = kBoundary;
    std::int32_t concavity = -1;  ///< index of the region, deepest first; -1: none
    double depth_m = 0.0;         ///< [m] of that region
    std::int32_t candidate = -1;  ///< index in the request's candidates; -1: none
};

/// The axis on which a hand at X_PG, its pads so far apart, closes; its reference is the hand's own
/// approach. Neither source nor concavity.
ClosingAxis axis_through(const Eigen::Isometry3d& X_PG, double width_m);

/// Grasp frame of Figs. 16-17: Gx along the axis, Gz turned about it from the reference direction,
/// origin in the middle between the axis's ends, or deeper.
Eigen::Isometry3d local_frame(const ClosingAxis& axis, const ApproachPose& pose);

/// The hand of a gripper on an axis, for a trace.
TracedCandidate traced(const ClosingAxis& axis, const ApproachPose& pose,
                       const std::string& gripper_name);

}  // namespace graspd::planner_detail
