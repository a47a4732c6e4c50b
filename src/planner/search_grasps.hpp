#pragma once

#include <optional>
#include <vector>

#include "evaluate_pose.hpp"
#include "find_concavities.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::planner_detail {

/// What a search found.
struct SearchResult {
    std::vector<GradedGrasp> grasps;  ///< in the order of the search
    Rejections rejections;
    std::vector<TracedBoundary> boundaries;  ///< where candidates are traced
    std::optional<Stopped> stopped;  ///< the caller wanted no more: the round under way was dropped
};

/// Whether a request wants candidates of a source.
bool is_wanted(GraspSource source, const PlanOptions& options);

/// Sections II-B to II-F for one gripper: a round for each concavity, one across its walls, one
/// across the whole object; then the best are refined, or left as they are when that is stopped.
/// @param seen  by a gripper with fingers of that size; across the solid, too, where the request
///              wants what is found there
SearchResult search_grasps(const Judgement& judgement, const SeenSurface& seen, StageLog& log);

}  // namespace graspd::planner_detail
