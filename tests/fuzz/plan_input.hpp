#pragma once

#include <limits>

#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/planner_config.hpp"
#include "targets.hpp"

namespace graspd::fuzz {

/// A call of plan() that is over soon.
struct PlanInput {
    PlanRequest request;
    PlannerConfig config;
    unsigned stop_after = std::numeric_limits<unsigned>::max();  ///< questions whether to stop
    bool twice = true;  ///< to be planned again: the reply must be the same
};

/// Builds a valid request from the bytes (400 faces or points at most), then damages it as often as
/// byte 0 says (modulo 5).
PlanInput make_plan_input(Bytes bytes);

}  // namespace graspd::fuzz
