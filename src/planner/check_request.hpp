#pragma once

#include <optional>

#include "graspd/base/result.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::planner_detail {

/// Checks everything of a request but the object's geometry, which its own stages check.
/// @return nothing, or the first field that is wrong with its value and range
std::optional<PlanError> check_request(const PlanRequest& request);

}  // namespace graspd::planner_detail
