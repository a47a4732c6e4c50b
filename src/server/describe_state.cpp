#include "describe_state.hpp"

namespace graspd::server {

PlannerState describe_state(const ServiceCounters& counters, const ServerConfig& config,
                            std::span<const Gripper> grippers, bool stopping) {
    PlannerState state;
    const bool full = counters.queued >= config.queue_capacity;
    state.mode = stopping ? PlannerState::Mode::kStopping
                 : full   ? PlannerState::Mode::kFull
                          : PlannerState::Mode::kReady;
    state.queue_length = static_cast<std::uint32_t>(counters.queued);
    state.queue_capacity = config.queue_capacity;
    state.workers = config.workers;
    state.busy_workers = static_cast<std::uint32_t>(counters.busy);
    state.cached_objects = static_cast<std::uint32_t>(counters.cached_objects);
    state.latency_p50_ms = counters.latency_p50_ms;
    state.latency_p95_ms = counters.latency_p95_ms;
    state.requests = counters.received;
    state.replies = counters.answers;
    state.lost_replies = counters.lost;
    state.abandoned_plans = static_cast<std::uint32_t>(counters.abandoned_plans);
    for (const Gripper& gripper : grippers) state.grippers.push_back(gripper.name);
    return state;
}

void describe_share(const ShareCounters& counters, PlannerState& state) {
    state.peers = static_cast<std::uint32_t>(counters.peers);
    state.held_requests = static_cast<std::uint32_t>(counters.held);
    state.taken_over = counters.taken_over;
}

}  // namespace graspd::server
