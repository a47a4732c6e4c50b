#pragma once

#include "graspd/base/result.hpp"
#include "graspd/dds/planner_state.hpp"
#include "wire_types.hpp"

namespace graspd::dds {

/// A planner's state on the wire, and back.
wire::PlannerStatus_ write_state(const PlannerState& state);
PlannerState read_state(const wire::PlannerStatus_& status);

/// The same for diagnostics tools: one status per planner, WARN when it is full or has lost
/// replies.
///
/// @param node  full name of the node, such as "/graspd"
diagnostic_msgs::msg::dds_::DiagnosticArray_ write_diagnostics(const PlannerState& state,
                                                               const std::string& node);

}  // namespace graspd::dds
