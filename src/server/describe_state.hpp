#pragma once

#include <span>

#include "graspd/dds/planner_state.hpp"
#include "planner_service.hpp"
#include "work_share.hpp"

namespace graspd::server {

/// What the daemon tells about itself. The port fills in who it is.
PlannerState describe_state(const ServiceCounters& counters, const ServerConfig& config,
                            std::span<const Gripper> grippers, bool stopping);
/// Adds what it shares with others.
void describe_share(const ShareCounters& counters, PlannerState& state);

}  // namespace graspd::server
