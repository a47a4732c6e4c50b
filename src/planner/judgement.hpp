#pragma once

#include <optional>

#include "graspd/base/gripper.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"

namespace graspd::planner_detail {

/// What one gripper's candidates are judged against.
struct Judgement {
    const PlanRequest& request;
    const PreparedObject& object;
    const CollisionWorld& world_P;
    const Gripper& gripper;
    const PlannerConfig& config;
    Eigen::Isometry3d X_FP = Eigen::Isometry3d::Identity();
    Eigen::Vector3d center_of_mass_P = Eigen::Vector3d::Zero();  ///< [m]
    double mass_kg = 0.1;
    std::optional<Eigen::Vector3d> down_P;  ///< unit, of gravity; absent: not known
    bool traced = false;                    ///< whether candidates are kept for a PlanTrace
};

}  // namespace graspd::planner_detail
