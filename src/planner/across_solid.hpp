#pragma once

#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/grasp/opposite_candidates.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"

namespace graspd::planner_detail {

/// Probes of the surface, and candidates from each of them across the solid.
struct AcrossSolid {
    SurfaceSamples probes;
    std::vector<OppositeCandidate> candidates;  ///< they index `probes`
    StageLog log;                               ///< of this work
};
/// Depends on the size of the gripper's fingers, on no limit of a request: candidates that are too
/// wide are among them, so that they are counted as such later.
/// @param sampler  of the object's surface
AcrossSolid look_across(const PreparedObject& object, const SurfaceSampler& sampler,
                        const Gripper& gripper, const PlannerConfig& config);
/// The same with a sampler of its own, for a surface that was seen before.
AcrossSolid look_across(const PreparedObject& object, const Gripper& gripper,
                        const PlannerConfig& config);

}  // namespace graspd::planner_detail
