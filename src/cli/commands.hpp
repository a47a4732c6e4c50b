#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "output.hpp"
#include "plan_arguments.hpp"

namespace graspd::cli {

/// How `request` reaches a daemon.
struct DdsArguments {
    std::optional<std::string> domain;  ///< as typed; absent: ROS_DOMAIN_ID, else 0
    std::string profile;                ///< Fast DDS profiles; empty: dds/loopback.xml
    double timeout_ms = 0.0;            ///< [ms] for each attempt; 0: time budget and some more
    std::uint32_t retries = 3;          ///< on silence and on OVERLOADED
};

// One function a subcommand; each returns the exit code (exit_code.hpp). Results go to standard
// output or --out, everything else to standard error.

/// Plans in this process.
int run_plan(const PlanArguments& plan, const std::string& config_file,
             const OutputArguments& output);

/// Has a daemon plan over DDS. Only in builds with GRASPD_BUILD_DDS.
int run_request(const PlanArguments& plan, const DdsArguments& dds, const OutputArguments& output);

/// Prints the concavity of every vertex or point of a file, in the file's order.
/// @param method  any_angle, tetrahedral, or empty: as configured
int run_concavity(const ObjectArguments& object, const std::string& method,
                  const std::string& config_file, const OutputArguments& output);

/// Lists the known grippers.
int run_grippers(const OutputArguments& output);

}  // namespace graspd::cli
