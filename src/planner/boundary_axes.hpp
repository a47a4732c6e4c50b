#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"

namespace graspd::planner_detail {

/// Sections II-C to II-E for one concavity: from its samples to the candidates P-Q along its
/// boundary, in its best planes.
///
/// Each P-Q is lifted out of the plane to the height at which the enlarged set's samples stand
/// near P and Q. A plane whose outline is degenerate gives no candidate.
/// @param trace  where the boundaries go, best plane first; null: nowhere
std::vector<ClosingAxis> boundary_axes(const Concavity& concavity, std::int32_t index,
                                       const SurfaceSamples& surface, const PreparedObject& object,
                                       const Gripper& gripper, const PlannerConfig& config,
                                       StageLog& log, std::vector<TracedBoundary>* trace = nullptr);

}  // namespace graspd::planner_detail
