#pragma once

#include <optional>
#include <string>

#include "graspd/planner/plan_trace.hpp"
#include "plan_in_process.hpp"

namespace graspd::cli {

/// Draws object.png, concavity.png (blue on the hull, red at the deepest), regions.png (salient
/// samples red, their surroundings yellow) and, with a grasp, grasp.png, all from one place. Needs
/// no display.
/// @return nothing, kUnsupported saying why there are no pictures, or kInternal naming the file
/// that
///         could not be written. In a build without the simulation: kUnsupported
std::optional<PlanError> write_report_pictures(const ProcessPlan& plan, const PlanTrace& trace,
                                               const std::string& directory);

}  // namespace graspd::cli
