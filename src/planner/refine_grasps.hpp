#pragma once

#include <vector>

#include "evaluate_pose.hpp"

namespace graspd::planner_detail {

/// Improves the best grasps by small moves: in counted rounds, each to either side along Gy and Gz
/// and about Gx, Gy and Gz, then half as far. The best move of a round is made if it raises the
/// score.
///
/// Moves along Gx are not tried: the closing fingers settle that. Grasps keep their places in the
/// list, and their source and concavity. Deterministic for any number of threads.
void refine_grasps(std::vector<GradedGrasp>& grasps, const Judgement& judgement, StageLog& log);

}  // namespace graspd::planner_detail
