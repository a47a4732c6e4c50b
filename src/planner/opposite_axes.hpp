#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "find_concavities.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"

namespace graspd::planner_detail {

/// Candidates across the solid: `wall` where an end lies in one of the concavities, else
/// `whole_object`. The first approach direction points towards the object's middle. None where
/// nobody looked across the solid.
std::vector<ClosingAxis> opposite_axes(const SeenSurface& seen, const PreparedObject& object,
                                       const Gripper& gripper, const PlannerConfig& config);

}  // namespace graspd::planner_detail
