#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "graspd/base/result.hpp"

namespace graspd {

/// ROS 2's variables about who is to be found; absent when unset or empty.
struct NetworkEnvironment {
    std::optional<std::string> discovery_range = std::nullopt;  ///< ROS_AUTOMATIC_DISCOVERY_RANGE
    std::optional<std::string> localhost_only = std::nullopt;   ///< ROS_LOCALHOST_ONLY
    std::optional<std::string> static_peers = std::nullopt;     ///< ROS_STATIC_PEERS
};

/// This process's variables. Not to be called while another thread changes the environment.
NetworkEnvironment network_environment();

/// Which network to join.
struct NetworkChoice {
    std::string profile_file;               ///< Fast DDS profiles; not looked at here
    std::vector<std::string> static_peers;  ///< hosts to look on: IPv4 addresses or names
    std::string why;                        ///< what decided, for the log
};

/// Chooses the Fast DDS profiles; the first that is said decides, what comes after is not judged:
///   profile_option (--profile)      that file
///   ROS_LOCALHOST_ONLY = 1          dds/loopback.xml, as rcl does since Iron
///   ROS_AUTOMATIC_DISCOVERY_RANGE   SUBNET: dds/lan.xml; LOCALHOST and SYSTEM_DEFAULT:
///                                   dds/loopback.xml; OFF: an error, nobody would find graspd
///   ROS_LOCALHOST_ONLY = 0          dds/lan.xml
///   nothing                         dds/loopback.xml
/// ROS_STATIC_PEERS, addresses and host names with ';' between them, goes with the choice. With
/// SYSTEM_DEFAULT and ROS_LOCALHOST_ONLY = 1 it is ignored (as by ROS 2); dds/loopback.xml reaches
/// 127.0.0.1 alone, so any other peer is then an error; whether a --profile reaches them is that
/// file's affair. Deviation: ROS 2 without variables means the subnet, graspd the loopback
/// interface; ROS 2 takes wrong values for LOCALHOST and 0; ROS 2 lets LOCALHOST find static peers
/// on other hosts.
/// @param profiles  the folder that holds dds/, see find_profiles()
/// @return kInvalidInput naming the variable, its value, and what to set instead
Result<NetworkChoice> choose_network(const std::string& profile_option,
                                     const std::filesystem::path& profiles,
                                     const NetworkEnvironment& environment);

}  // namespace graspd
