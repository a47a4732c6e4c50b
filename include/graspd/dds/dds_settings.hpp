#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

/// What both ends of the wire need to know before they join a domain.
struct DdsSettings {
    std::uint32_t domain = 0;  ///< DDS domain id, 0..232
    /// XML file with the profiles that graspd uses, such as profiles/dds/loopback.xml; required.
    /// Nothing else is read: neither the environment's profile nor one in the working folder.
    std::string profile_file;
    std::vector<std::string> static_peers;  ///< further hosts where to look for participants
    WireNames names;
    RosNode node;
    std::string planner_id;                        ///< names this process in its replies
    std::string version;                           ///< likewise, such as "0.1.0"
    std::string config_hash;                       ///< likewise, 16 hexadecimal digits
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [byte] a larger sample is refused unread
    bool keep_payloads = false;                    ///< IncomingRequest::payload() has the bytes
};

}  // namespace graspd
