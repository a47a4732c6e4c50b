#pragma once

#include <map>
#include <string>

#include "graspd/planner/plan_types.hpp"

namespace graspd::test {

/// What a suggestion says, read by nothing but the grammar of docs/interface.md.
struct ReadSuggestion {
    std::map<std::string, double> to;    ///< "max_width" -> 0.105; "approach_cones" -> 0: none
    std::map<std::string, double> from;  ///< what they are "instead of"
    bool all_sources = false;
    double score = 0.0;    ///< promised; 0: none
    double instead = 0.0;  ///< the best score without it; 0: not said
};
ReadSuggestion read_suggestion(const std::string& text);

/// The request with every change that a suggestion names.
PlanRequest applied(PlanRequest request, const std::string& suggestion);

}  // namespace graspd::test
