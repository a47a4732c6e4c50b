#pragma once

#include <string>

#include "graspd/planner/planner_config.hpp"
#include "plan_arguments.hpp"
#include "write_json.hpp"

namespace graspd::cli {

/// A plan and what it was made from.
struct ProcessPlan {
    PlanRequest request;
    PlannerConfig config;
    PlanReply reply;
    ResultOrigin origin;
};

/// Plans without a daemon, within the time budget.
/// @return the first wrong argument; a plan that fails is a reply
Result<ProcessPlan> plan_in_process(const PlanArguments& arguments, const std::string& config_file);

}  // namespace graspd::cli
