#pragma once

#include <array>
#include <optional>

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

/// What ranking needs to know of a grasp.
inline RankedEntry entry_of(const GradedGrasp& grasp) {
    return {grasp.score.score, grasp.X_PG, grasp.gripper->finger_width_m, grasp.axis.concavity};
}

/// A pose that was examined, for a trace.
TracedCandidate traced(const GradedGrasp& grasp);

/// Sections II-E (local frame and cloud) and II-F for one pose: can the hand stand there, where do
/// its pads touch, do the two sides balance, is the whole motion free. A pose that falls is
/// counted by its typed reason.
std::optional<GradedGrasp> evaluate_pose(const ClosingAxis& axis, const ApproachPose& approach,
                                         const Judgement& judgement, Rejections& rejections,
                                         StageLog& log);

/// The same for a pose beside one that was examined, with the pads as far apart: nothing is
/// counted.
std::optional<GradedGrasp> evaluate_beside(const Eigen::Isometry3d& X_PG, double width_m,
                                           const Judgement& judgement);

}  // namespace graspd::planner_detail
