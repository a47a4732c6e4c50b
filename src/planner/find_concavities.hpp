#pragma once

#include <optional>
#include <vector>

#include "across_solid.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"
#include "stage_log.hpp"

namespace graspd::planner_detail {

/// The concavities of a surface at several salience thresholds, deepest first, none when convex.
///
/// Source: Lei & Wisse 2016, Sec. II-B.
/// Deviation: one threshold hides the shallower concavities of an object that has one deep one.
/// Lower thresholds follow; a region that only repeats a known one, a little larger, is left out.
Result<std::vector<Concavity>> find_concavities(const SurfaceSamples& surface,
                                                double finger_thickness_m,
                                                const PlannerConfig& config, StageLog& log);

/// What a gripper's search sees of an object: depends on the size of its fingers, on no limit.
struct SeenSurface {
    SurfaceSamples surface;
    std::vector<Concavity> concavities;  ///< of `surface`, deepest first
    std::optional<AcrossSolid> across;   ///< once somebody wanted it
};
/// Samples the surface as finely as a finger is wide, and finds its concavities; beside that, where
/// it is wanted, looks across the solid.
Result<SeenSurface> see_surface(const PreparedObject& object, const Gripper& gripper,
                                const PlannerConfig& config, bool across_too, StageLog& log);

}  // namespace graspd::planner_detail
