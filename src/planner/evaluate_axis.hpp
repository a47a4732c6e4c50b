#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"
#include "rejections.hpp"

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
};

/// A grasp that holds and whose motion is free, in P.
struct GradedGrasp {
    ClosingAxis axis;
    Eigen::Isometry3d X_PG = Eigen::Isometry3d::Identity();
    double width_m = 0.0, open_width_m = 0.0;
    std::array<Contact, 2> contacts_P;  ///< left, right
    GraspEvidence evidence;
    GraspScore score;
    const Gripper* gripper = nullptr;
};

/// Sections II-E (local frames and clouds) and II-F for one closing axis: every approach direction
/// about it and every depth is checked for motion, contact, force balance and friction. Those that
/// fall are counted by their typed reason.
std::vector<GradedGrasp> evaluate_axis(const ClosingAxis& axis, const Judgement& judgement,
                                       Rejections& rejections, StageLog& log);

}  // namespace graspd::planner_detail
