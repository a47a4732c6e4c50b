#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/config/ros_arguments.hpp"
#include "graspd/dds/dds_settings.hpp"
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
    bool supervise = false;                ///< start the participant again when it crashes
    RosArguments ros;                      ///< what stands after --ros-args
};

/// Reads the command line.
/// @return the arguments, or the exit code when there is nothing more to do: 0 after --help and
///         --version, 2 after a wrong argument, which standard error explains
std::variant<DaemonArguments, int> parse_daemon_arguments(int argc, const char* const* argv);

/// The settings in force: the file over the defaults, then ROS 2's parameter files, its -p, and
/// --workers. The parameters use_sim_time and qos_overrides.*, which launch files set for every
/// node, are passed over: no result depends on the clock, and the QoS is the contract's.
/// @return kUnreadableFile or kInvalidInput naming key, value and range
Result<DaemonConfig> daemon_config(const DaemonArguments& arguments);

/// The node as ROS 2 tools will show it.
RosNode ros_node(const RosArguments& ros, const RosConfig& config);

/// MoveIt's service as configured.
/// @return kUnknownGripper for a default gripper that is none of the hands'
Result<MoveItSettings> moveit_settings(const RosConfig& config, std::vector<MoveItHand> hands);

}  // namespace graspd::server
