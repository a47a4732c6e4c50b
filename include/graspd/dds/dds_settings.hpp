#pragma once

#include <cstdint>
#include <string>

namespace graspd {

/// What both ends of the wire need to know before they join a domain.
struct DdsSettings {
    std::uint32_t domain = 0;  ///< DDS domain id, 0..232
    /// XML file with the profiles that graspd uses, such as profiles/dds/loopback.xml; required.
    /// Nothing else is read: neither the environment's profile nor one in the working folder.
    std::string profile_file;
    std::string planner_id;                        ///< names this process in its replies
    std::string version;                           ///< likewise, such as "0.1.0"
    std::string config_hash;                       ///< likewise, 16 hexadecimal digits
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [byte] a larger sample is refused unread
};

}  // namespace graspd
