#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"

namespace graspd::planner_detail {

/// Candidates across the solid: `wall` where an end lies in one of the concavities, else
/// `whole_object`. The first approach direction points towards the object's middle.
///
/// @param surface  the samples that `regions` indexes
std::vector<ClosingAxis> opposite_axes(const std::vector<Concavity>& regions,
                                       const SurfaceSamples& surface, const PreparedObject& object,
                                       const Gripper& gripper, const PlannerConfig& config,
                                       StageLog& log);

}  // namespace graspd::planner_detail
