#pragma once

#include <vector>

#include "evaluate_pose.hpp"

namespace graspd::planner_detail {

/// Ranks what the searches found, measures the clearance of the best, and says it in F.
///
/// Those below the request's least clearance fall first. How much clearance a grasp has is measured
/// for twice as many as are wanted.
/// @param grasps      of all grippers, scored without clearance
/// @param world_P     what is around the gripper
/// @return at most max_grasps grasps, best first; duplicates, surplus and clearance are counted
Result<std::vector<Grasp>> select_grasps(std::vector<GradedGrasp> grasps,
                                         const CollisionWorld& world_P, const PlanRequest& request,
                                         const PlannerConfig& config, const Eigen::Isometry3d& X_FP,
                                         Rejections& rejections, StageLog& log);

}  // namespace graspd::planner_detail
