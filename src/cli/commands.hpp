#pragma once

#include "output.hpp"
#include "plan_arguments.hpp"

namespace graspd::cli {

// One function a subcommand; each returns the exit code (exit_code.hpp). Results go to standard
// output or --out, everything else to standard error.

/// Plans in this process.
int run_plan(const PlanArguments& plan, const std::string& config_file,
             const OutputArguments& output);

/// Lists the known grippers.
int run_grippers(const OutputArguments& output);

}  // namespace graspd::cli
