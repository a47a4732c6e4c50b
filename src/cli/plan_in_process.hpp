#pragma once

#include <string>

#include "graspd/planner/plan_trace.hpp"
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
/// @param trace  as plan() takes it
/// @return the first wrong argument; a plan that fails is a reply
Result<ProcessPlan> plan_in_process(const PlanArguments& arguments, const std::string& config_file,
                                    PlanTrace* trace = nullptr);

}  // namespace graspd::cli
