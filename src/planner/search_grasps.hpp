#pragma once

#include <vector>

#include "evaluate_pose.hpp"
#include "find_concavities.hpp"
#include "graspd/planner/planner.hpp"

namespace graspd::planner_detail {

/// What a search found.
struct SearchResult {
    std::vector<GradedGrasp> grasps;  ///< in the order of the search
    Rejections rejections;
    bool stopped = false;  ///< the caller wanted no more; the round under way was dropped
};

/// Sections II-B to II-F for one gripper: a round for each concavity, one across its walls, one
/// across the whole object.
/// @param seen            by a gripper with fingers of that size
/// @param stop_requested  asked before each round and within; may be empty
SearchResult search_grasps(const Judgement& judgement, const SeenSurface& seen,
                           const StopQuery& stop_requested, StageLog& log);

}  // namespace graspd::planner_detail
