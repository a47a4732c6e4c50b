#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/suggest_config.hpp"
#include "rejections.hpp"

namespace graspd::planner_detail {

/// Plans a request with other limits, same object and surroundings.
/// @return its grasps, best first, none when there is none
using Replan = std::function<std::vector<Grasp>(const PlanRequest&)>;

/// A plan that was made to its end.
struct Verdict {
    const PlanRequest& request;
    const std::vector<Grasp>& grasps;  ///< best first; empty: NO_GRASP
    const Rejections& rejections;
    double widest_m = 0.0;  ///< [m] opening into which the object fits any way
};

/// One sentence, and what it cost.
struct Suggestion {
    std::string text;
    std::uint64_t plans = 0;  ///< how often it was planned again
};

/// Computes which relaxed limit would give a grasp, or a better one, by planning again.
///
/// Without grasps: of the limits by which candidates fell, the one whose least relaxation is the
/// smallest share of what was asked for. The least relaxation is what the nearest miss needs when
/// that gives a grasp, else it is bisected between there and the loosest value. When no limit is
/// enough alone, all are relaxed at once, and those that are not needed are restored.
/// With grasps: of the limits by which candidates fell, the one that raises the best score most,
/// relaxed to what the better grasp needs. Friction is left out: it raises every score by itself.
///
/// What the text promises was planned with the very numbers that it shows, so it comes true when it
/// is applied. Forms, fit for a parser (docs/interface.md, Suggestions):
///   with CHANGE [and CHANGE ...] there is a grasp of score S
///   with CHANGE the best score is S instead of S
///   no grasp even with VALUE[, VALUE ...] together
///   no limit keeps out a grasp that is better by G than S: tried VALUE[, VALUE ...]
/// Cost: at most 5 (bisections + 2) + 7 plans, in most cases 1 to 3.
Suggestion suggest(const Verdict& verdict, const SuggestConfig& config, const Replan& replan);

}  // namespace graspd::planner_detail
