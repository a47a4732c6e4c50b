#pragma once

#include <string>

#include "graspd/planner/plan_types.hpp"
#include "graspd/simulate/simulate_grasp.hpp"

namespace graspd::cli {

/// One executed grasp of a plan.
struct SimulationRun {
    std::size_t rank = 1;
    SimulationConfig config;
    SimulationResult result;
};

/// The plan as JSON (write_json) with one more member, `simulation`: metres, radians, kg, N.
std::string write_simulation_json(const std::string& plan_json, const SimulationRun& run);

/// The verdict and its figures in one line for people.
std::string write_simulation_line(const PlanReply& reply, const SimulationRun& run);

}  // namespace graspd::cli
