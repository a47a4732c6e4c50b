#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon_arguments.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/dds/dds_settings.hpp"

namespace graspd::server {

/// Everything that was read before a thread starts.
struct Setup {
    DaemonConfig config;
    DdsSettings dds;
    std::string network_why;  ///< what chose the profile file
    std::vector<Gripper> grippers;
    std::uint32_t restarts = 0;  ///< by the supervisor
};

/// Reads profiles, grippers and what the environment says.
/// @return kUnreadableFile or kInvalidInput naming the file, or the setting and its value
Result<Setup> read_setup(const DaemonArguments& arguments, const DaemonConfig& config);

}  // namespace graspd::server
