#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graspd/base/moveit_hand.hpp"
#include "graspd/base/security_enclave.hpp"
#include "graspd/base/wire_names.hpp"

namespace graspd {

/// How many bytes a Gid has in the graph's messages: 24 up to ROS 2 Humble, 16 from Iron on, under
/// one type name. A message of the wrong length breaks the graph tools of everybody.
enum class GidBytes : std::uint8_t {
    kAuto = 0,  ///< as the first ROS 2 node that is heard of; nothing is announced before
    kOff = 1,   ///< the planner is no node
    k16 = 16,
    k24 = 24,
};

/// What ROS 2 tools show of this process.
struct RosNode {
    std::string name = "graspd";
    std::string node_namespace = "/";
    std::string enclave = "/";
    GidBytes gid_bytes = GidBytes::kOff;
};

/// Namespace and name, such as "/graspd".
inline std::string full_name(const RosNode& node) {
    return (node.node_namespace == "/" ? "" : node.node_namespace) + "/" + node.name;
}

/// How much geometry a request may hold. What is over a limit is counted before it is read, and
/// refused by a reply that names it.
struct RequestLimits {
    std::uint32_t max_vertices = 2000000;  ///< of the object's mesh
    std::uint32_t max_faces = 4000000;
    std::uint32_t max_points = 5000000;          ///< of the object's cloud
    std::uint32_t max_obstacle_faces = 1000000;  ///< of all obstacles together
};

/// The layout of moveit_msgs/MoveItErrorCodes, which grew under one type name: val alone up to
/// Iron, with message and source behind it from Jazzy on.
enum class MoveItCodes : std::uint8_t { kOff = 0, kHumble, kJazzy };

/// The service /plan_grasps for MoveIt.
struct MoveItSettings {
    MoveItCodes error_codes = MoveItCodes::kOff;  ///< kOff: there is no such service
    std::string gripper;            ///< for calls without a group_name; empty: the first known one
    std::vector<MoveItHand> hands;  ///< by gripper
};

/// What both ends of the wire need to know before they join a domain.
struct DdsSettings {
    std::uint32_t domain = 0;  ///< DDS domain id, 0..232
    /// XML file with the profiles that graspd uses, such as profiles/dds/loopback.xml; required.
    /// Nothing else is read: neither the environment's profile nor one in the working folder.
    std::string profile_file;
    std::vector<std::string> static_peers;    ///< further hosts where to look for participants
    std::optional<SecurityEnclave> security;  ///< absent: everybody may speak, read and listen
    WireNames names;
    RosNode node;
    MoveItSettings moveit;
    std::string planner_id;                        ///< names this process in its replies
    std::string version;                           ///< likewise, such as "0.1.0"
    std::string config_hash;                       ///< likewise, 16 hexadecimal digits
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [byte] of a larger sample no more is read
                                                   ///< than who sent it
    RequestLimits limits;
    bool keep_payloads = false;  ///< IncomingRequest::payload() has the bytes
    bool markers = true;         ///< a planner has the topic for pictures
    bool watch_peers = false;    ///< a planner hears of other planners and of their replies
};

}  // namespace graspd
