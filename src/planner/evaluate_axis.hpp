#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "judgement.hpp"
#include "rejections.hpp"
#include "stage_log.hpp"

namespace graspd::planner_detail {

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

/// Sections II-E (local frames and clouds) and II-F for one closing axis: each of its poses is
/// checked for motion, contact, force balance and friction. Those that
/// fall are counted by their typed reason.
std::vector<GradedGrasp> evaluate_axis(const ClosingAxis& axis, const Judgement& judgement,
                                       Rejections& rejections, StageLog& log);

}  // namespace graspd::planner_detail
