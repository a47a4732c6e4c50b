#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "graspd/planner/planner_config.hpp"

namespace graspd::server {

/// When the picture of a plan is published.
enum class MarkersWhen : std::uint8_t { kNever, kOnRequest, kAlways };

/// How the daemon takes requests; group `server` of planner.yaml.
struct ServerConfig {
    static constexpr std::array<std::string_view, 3> kMarkers = {"never", "on_request", "always"};

    std::uint32_t workers = 2;                     ///< threads that plan
    std::uint32_t queue_capacity = 16;             ///< waiting requests; more are OVERLOADED
    std::uint32_t reply_cache_entries = 1024;      ///< replies kept for retries
    std::uint64_t reply_cache_bytes = 64u << 20;   ///< [bytes] that those may take
    std::uint64_t object_cache_bytes = 256 << 20;  ///< [bytes] of objects kept under their keys
    std::uint32_t max_payload_bytes = 256u << 20;  ///< [bytes] a larger request is refused
    std::uint32_t max_obstacle_faces = 1000000;    ///< of all obstacles of a request together
    std::uint64_t max_memory_bytes = std::uint64_t{6} << 30;  ///< [bytes] for planning a request
    std::uint64_t max_address_space_bytes = 0;  ///< [bytes] of the process; 0: no limit
    std::uint32_t abandoned_plans = 2;          ///< after so many the process ends; 0: never
    std::uint32_t abandon_after_ms = 1000;      ///< [ms] beyond its budget: a plan is lost
    std::uint32_t idle_trim_ms = 5000;  ///< [ms] idle: freed memory goes to the system; 0: never

    std::string record_dir;                     ///< requests are written there; empty: nowhere
    std::uint32_t record_max_requests = 1000;   ///< of them that are kept
    std::uint64_t record_max_bytes = 1u << 30;  ///< [bytes] that those may take

    /// When a plan is drawn on the topic markers. never: there is no such topic, and a request that
    /// asks for it is refused.
    std::string markers = "on_request";
    /// Of the object, as many points of regions, as many faces of all hands. The largest picture
    /// (216 bytes each) is far below what a DDS sample may hold.
    std::uint32_t markers_max_faces = 20000;
    std::uint32_t markers_max_grasps = 10;  ///< whose hands are drawn

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        constexpr std::uint64_t kTerabyte = std::uint64_t{1} << 40;
        visit("workers", self.workers, 1u, 256u);
        visit("queue_capacity", self.queue_capacity, 1u, 100000u);
        visit("reply_cache_entries", self.reply_cache_entries, 1u, 1000000u);
        visit("reply_cache_bytes", self.reply_cache_bytes, std::uint64_t{1} << 16, kTerabyte);
        visit("object_cache_bytes", self.object_cache_bytes, std::uint64_t{0}, kTerabyte);
        visit("max_payload_bytes", self.max_payload_bytes, 1024u, 2147483647u);
        visit("max_obstacle_faces", self.max_obstacle_faces, 0u, 100000000u);
        visit("max_memory_bytes", self.max_memory_bytes, std::uint64_t{1} << 20, kTerabyte);
        visit("max_address_space_bytes", self.max_address_space_bytes, std::uint64_t{0},
              std::uint64_t{1} << 46);
        visit("abandoned_plans", self.abandoned_plans, 0u, 1000u);
        visit("abandon_after_ms", self.abandon_after_ms, 1u, 3600000u);
        visit("idle_trim_ms", self.idle_trim_ms, 0u, 3600000u);
        visit("record_dir", self.record_dir);
        visit("record_max_requests", self.record_max_requests, 1u, 1000000u);
        visit("record_max_bytes", self.record_max_bytes, std::uint64_t{1} << 16, kTerabyte);
        visit("markers", self.markers, Choices(kMarkers));
        visit("markers_max_faces", self.markers_max_faces, 100u, 200000u);
        visit("markers_max_grasps", self.markers_max_grasps, 1u, 100u);
    }
    MarkersWhen markers_when() const {
        if (markers == kMarkers[0]) return MarkersWhen::kNever;
        return markers == kMarkers[2] ? MarkersWhen::kAlways : MarkersWhen::kOnRequest;
    }
};

/// How the daemon shows itself to ROS 2; group `ros` of planner.yaml.
struct RosConfig {
    static constexpr std::array<std::string_view, 4> kGidBytes = {"auto", "off", "16", "24"};
    static constexpr std::array<std::string_view, 3> kErrorCodes = {"jazzy", "humble", "off"};

    /// Bytes of a Gid on ros_discovery_info: 24 up to Humble, 16 from Iron on; auto: as the first
    /// node that is heard of; off: graspd is no node.
    std::string gid_bytes = "auto";
    /// Layout of the error code of MoveIt's service /plan_grasps; off: no such service.
    std::string moveit_error_codes = "jazzy";
    /// Gripper of MoveIt's calls without a group_name; empty: the first by name.
    std::string moveit_gripper;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("gid_bytes", self.gid_bytes, Choices(kGidBytes));
        visit("moveit_error_codes", self.moveit_error_codes, Choices(kErrorCodes));
        visit("moveit_gripper", self.moveit_gripper);
    }
};

/// How `graspd --supervise` starts the participant again; group `supervisor` of planner.yaml.
struct SupervisorConfig {
    double first_wait_s = 0.1;      ///< [s] before the first start after a crash; doubles each time
    double longest_wait_s = 10.0;   ///< [s] it doubles up to here
    double healthy_after_s = 60.0;  ///< [s] after so long a life the next wait is the first again

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("first_wait_s", self.first_wait_s, 0.001, 60.0);
        visit("longest_wait_s", self.longest_wait_s, 0.001, 3600.0);
        visit("healthy_after_s", self.healthy_after_s, 0.001, 86400.0);
    }
};

/// How several planners of one domain share the requests; group `share` of planner.yaml.
struct ShareConfig {
    bool enabled = false;  ///< all planners of the domain must agree
    /// Requests that a peer is to answer are kept, should it be lost; the oldest are forgotten
    /// beyond this.
    std::uint32_t max_held_requests = 1024;
    std::uint64_t max_held_bytes = 256u << 20;  ///< [bytes] that those may take

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("enabled", self.enabled);
        visit("max_held_requests", self.max_held_requests, 1u, 1000000u);
        visit("max_held_bytes", self.max_held_bytes, std::uint64_t{1} << 16,
              std::uint64_t{1} << 40);
    }
};

/// Everything that planner.yaml can set for the daemon.
struct DaemonConfig {
    PlannerConfig planner;
    ServerConfig server;
    ShareConfig share;
    RosConfig ros;
    SupervisorConfig supervisor;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        PlannerConfig::describe(self.planner, visit);
        visit("server", self.server);
        visit("share", self.share);
        visit("ros", self.ros);
        visit("supervisor", self.supervisor);
    }
};

}  // namespace graspd::server
