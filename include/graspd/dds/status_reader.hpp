#pragma once

#include <chrono>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/dds/dds_settings.hpp"
#include "graspd/dds/planner_state.hpp"

namespace graspd {

/// The planners of a domain that are alive, by planner_id: the latest state of each whose status
/// arrives within `wait`. A first match can take 3 s, a planner speaks once a second.
///
/// @return none when nobody spoke; an error as PlannerPort::open
Result<std::vector<PlannerState>> read_planner_states(const DdsSettings& settings,
                                                      std::chrono::milliseconds wait);

}  // namespace graspd
