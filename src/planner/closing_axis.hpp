#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "graspd/planner/plan_types.hpp"

namespace graspd::planner_detail {

/// A line that a hand could close along, from whichever source. Frame P throughout.
struct ClosingAxis {
    Eigen::Vector3d left_P = Eigen::Vector3d::Zero();       ///< [m] place at -Gx
    Eigen::Vector3d right_P = Eigen::Vector3d::Zero();      ///< [m] place at +Gx
    Eigen::Vector3d reference_P = Eigen::Vector3d::Zero();  ///< unit: the first approach direction,
                                                            ///< at right angles to left-right
    GraspSource source = kBoundary;
    std::int32_t concavity = -1;  ///< index of the region, deepest first; -1: none
    double depth_m = 0.0;         ///< [m] of that region
};

}  // namespace graspd::planner_detail
