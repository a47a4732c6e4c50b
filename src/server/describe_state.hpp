#pragma once

#include <span>

#include "graspd/dds/planner_state.hpp"
#include "planner_service.hpp"

namespace graspd::server {

/// What the daemon tells about itself. The port fills in who it is.
PlannerState describe_state(const ServiceCounters& counters, const ServerConfig& config,
                            std::span<const Gripper> grippers, bool stopping);

}  // namespace graspd::server
