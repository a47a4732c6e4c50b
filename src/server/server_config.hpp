#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "graspd/planner/planner_config.hpp"

namespace graspd::server {

/// How the daemon takes requests; group `server` of planner.yaml.
struct ServerConfig {
    std::uint32_t workers = 2;                     ///< threads that plan
    std::uint32_t queue_capacity = 16;             ///< waiting requests; more are OVERLOADED
    std::uint32_t reply_cache_entries = 1024;      ///< replies kept for retries
    std::uint64_t reply_cache_bytes = 64u << 20;   ///< [bytes] that those may take
    std::uint64_t object_cache_bytes = 256 << 20;  ///< [bytes] of objects kept under their keys
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [bytes] a larger request is rejected

    std::string record_dir;                     ///< requests are written there; empty: nowhere
    std::uint32_t record_max_requests = 1000;   ///< of them that are kept
    std::uint64_t record_max_bytes = 1u << 30;  ///< [bytes] that those may take

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        constexpr std::uint64_t kTerabyte = std::uint64_t{1} << 40;
        visit("workers", self.workers, 1u, 256u);
        visit("queue_capacity", self.queue_capacity, 1u, 100000u);
        visit("reply_cache_entries", self.reply_cache_entries, 1u, 1000000u);
        visit("reply_cache_bytes", self.reply_cache_bytes, std::uint64_t{1} << 16, kTerabyte);
        visit("object_cache_bytes", self.object_cache_bytes, std::uint64_t{0}, kTerabyte);
        visit("max_payload_bytes", self.max_payload_bytes, 1024u, 2147483647u);
        visit("record_dir", self.record_dir);
        visit("record_max_requests", self.record_max_requests, 1u, 1000000u);
        visit("record_max_bytes", self.record_max_bytes, std::uint64_t{1} << 16, kTerabyte);
    }
};

/// How the daemon shows itself to ROS 2; group `ros` of planner.yaml.
struct RosConfig {
    static constexpr std::array<std::string_view, 4> kGidBytes = {"auto", "off", "16", "24"};

    /// Bytes of a Gid on ros_discovery_info: 24 up to Humble, 16 from Iron on; auto: as the first
    /// node that is heard of; off: graspd is no node.
    std::string gid_bytes = "auto";

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("gid_bytes", self.gid_bytes, Choices(kGidBytes));
    }
};

/// Everything that planner.yaml can set for the daemon.
struct DaemonConfig {
    PlannerConfig planner;
    ServerConfig server;
    RosConfig ros;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        PlannerConfig::describe(self.planner, visit);
        visit("server", self.server);
        visit("ros", self.ros);
    }
};

}  // namespace graspd::server
