#pragma once

#include <string>

#include "graspd/planner/plan_trace.hpp"
#include "plan_in_process.hpp"

namespace graspd::cli {

/// Everything that the report page shows, as one JSON object, schema graspd-report/1.
///
/// Metres. What has places lies in the request's frame F less `origin` (the object's middle), so
/// that floats will do; many numbers at once are base64 of little-endian arrays: float32, or uint32
/// for indices. Member `reply` is the reply as write_json() has it, in F itself.
/// @param file  what the object was read from; its last part is shown
std::string report_data(const ProcessPlan& plan, const PlanTrace& trace, const std::string& file);

}  // namespace graspd::cli
