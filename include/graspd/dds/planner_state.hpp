#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace graspd {

/// What a planner says of itself once a second; the fields of PlannerStatus in idl/graspd.idl.
struct PlannerState {
    enum class Mode : std::uint8_t {
        kReady = 0,     ///< takes requests
        kFull = 1,      ///< would answer OVERLOADED
        kStopping = 2,  ///< finishes what it has and takes no more
    };
    std::string planner_id;   ///< filled in by the port
    std::string version;      ///< likewise
    std::string config_hash;  ///< likewise
    Mode mode = Mode::kReady;
    std::uint32_t queue_length = 0;  ///< requests that wait
    std::uint32_t queue_capacity = 0;
    std::uint32_t workers = 0;
    std::uint32_t busy_workers = 0;
    std::uint32_t cached_objects = 0;
    double latency_p50_ms = 0.0;             ///< [ms] receipt to reply, over the recent requests
    double latency_p95_ms = 0.0;             ///< [ms]
    std::uint64_t requests = 0;              ///< taken since the start
    std::array<std::uint64_t, 9> replies{};  ///< since the start, by PlanStatus
    std::uint64_t lost_replies = 0;          ///< that a full history or a slow reader cost
    std::uint64_t rejected_payloads = 0;     ///< malformed samples; filled in by the port
    std::uint32_t restarts = 0;              ///< of the participant by its supervisor
    std::uint32_t abandoned_plans = 0;       ///< that overran their time budget and were given up
    // Of planners that share requests, in the diagnostics alone:
    std::uint32_t peers = 0;            ///< other planners that serve
    std::uint32_t held_requests = 0;    ///< that a peer is to answer
    std::uint64_t taken_over = 0;       ///< since the start, of peers that were lost
    std::vector<std::string> grippers;  ///< profiles that are loaded
};

/// "READY", "FULL", "STOPPING".
const char* to_string(PlannerState::Mode mode);

}  // namespace graspd
