#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "graspd/base/result.hpp"
#include "server_config.hpp"

namespace graspd::server {

/// What the command line of graspd can say.
struct DaemonArguments {
    std::string config_file;               ///< planner.yaml; empty: built-in values
    std::string profile_file;              ///< Fast DDS profiles; empty: dds/loopback.xml
    std::optional<std::string> domain;     ///< as typed; absent: ROS_DOMAIN_ID, else 0
    std::optional<std::uint32_t> workers;  ///< absent: as configured
    std::string log_level = "info";        ///< debug, info, warning, error or off
    bool print_config = false;             ///< print the settings in force and leave
};

/// Reads the command line.
/// @return the arguments, or the exit code when there is nothing more to do: 0 after --help and
///         --version, 2 after a wrong argument, which standard error explains
std::variant<DaemonArguments, int> parse_daemon_arguments(int argc, const char* const* argv);

/// The settings in force: the file over the defaults, --workers over both.
/// @return kUnreadableFile or kInvalidInput naming key, value and range
Result<DaemonConfig> daemon_config(const DaemonArguments& arguments);

}  // namespace graspd::server
