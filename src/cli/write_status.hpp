#pragma once

#include <span>
#include <string>

#include "graspd/dds/planner_state.hpp"

namespace graspd::cli {

/// One row a planner: state, queue, workers, requests, latencies, version.
std::string write_status_table(std::span<const PlannerState> planners);

/// {"schema": "graspd/1", "planners": [...]} with every field of PlannerStatus.
std::string write_status_json(std::span<const PlannerState> planners);

}  // namespace graspd::cli
