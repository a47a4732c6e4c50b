#pragma once

#include "search_grasps.hpp"

namespace graspd::planner_detail {

/// Judges the hand poses that a request brings along, in place of a search (Sec. II-E and II-F for
/// each). Where the closing pads would meet the object says how wide the grasp is; the pose is
/// moved along Gx so that both pads touch at once. No pose is improved, and none stands for a like
/// one.
///
/// A candidate that falls is counted by its typed reason: those of evaluate_pose(), no_contact,
/// too_thin, outside_approach_cones. When this is stopped, what was judged in full blocks is kept.
/// @return grasps with their candidate's index, in the order of the candidates
SearchResult judge_candidates(const Judgement& judgement, StageLog& log);

}  // namespace graspd::planner_detail
