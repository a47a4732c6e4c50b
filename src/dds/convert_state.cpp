#include "convert_state.hpp"

#include <chrono>

#include "graspd/planner/plan_types.hpp"

namespace graspd {

const char* to_string(PlannerState::Mode mode) {
    switch (mode) {
        case PlannerState::Mode::kReady: return "READY";
        case PlannerState::Mode::kFull: return "FULL";
        case PlannerState::Mode::kStopping: return "STOPPING";
    }
    return "UNKNOWN";
}

namespace dds {
namespace {

using diagnostic_msgs::msg::dds_::DiagnosticStatus_;
namespace level = diagnostic_msgs::msg::dds_::DiagnosticStatus__Constants;

/// When it was said; the only use of the wall clock on the wire.
std_msgs::msg::dds_::Header_ stamped_now() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now);
    const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(now - seconds);
    std_msgs::msg::dds_::Header_ header;
    header.stamp().sec(static_cast<std::int32_t>(seconds.count()));
    header.stamp().nanosec(static_cast<std::uint32_t>(rest.count()));
    return header;
}

void add(DiagnosticStatus_& status, const char* key, const std::string& value) {
    auto& entry = status.values().emplace_back();
    entry.key(key);
    entry.value(value);
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
    return text;
}

}  // namespace

wire::PlannerStatus_ write_state(const PlannerState& state) {
    wire::PlannerStatus_ out;
    out.header(stamped_now());
    out.planner_id(state.planner_id);
    out.planner_version(state.version);
    out.config_hash(state.config_hash);
    out.state(static_cast<std::uint8_t>(state.mode));
    out.queue_length(state.queue_length);
    out.queue_capacity(state.queue_capacity);
    out.workers(state.workers);
    out.busy_workers(state.busy_workers);
    out.cached_objects(state.cached_objects);
    out.latency_p50_ms(state.latency_p50_ms);
    out.latency_p95_ms(state.latency_p95_ms);
    out.requests(state.requests);
    out.replies(state.replies);
    out.lost_replies(state.lost_replies);
    out.rejected_payloads(state.rejected_payloads);
    out.restarts(state.restarts);
    out.abandoned_plans(state.abandoned_plans);
    out.grippers(state.grippers);
    return out;
}

PlannerState read_state(const wire::PlannerStatus_& status) {
    return {.planner_id = status.planner_id(),
            .version = status.planner_version(),
            .config_hash = status.config_hash(),
            .mode = static_cast<PlannerState::Mode>(status.state()),
            .queue_length = status.queue_length(),
            .queue_capacity = status.queue_capacity(),
            .workers = status.workers(),
            .busy_workers = status.busy_workers(),
            .cached_objects = status.cached_objects(),
            .latency_p50_ms = status.latency_p50_ms(),
            .latency_p95_ms = status.latency_p95_ms(),
            .requests = status.requests(),
            .replies = status.replies(),
            .lost_replies = status.lost_replies(),
            .rejected_payloads = status.rejected_payloads(),
            .restarts = status.restarts(),
            .abandoned_plans = status.abandoned_plans(),
            .grippers = status.grippers()};
}

diagnostic_msgs::msg::dds_::DiagnosticArray_ write_diagnostics(const PlannerState& state,
                                                               const std::string& node) {
    diagnostic_msgs::msg::dds_::DiagnosticArray_ out;
    out.header(stamped_now());
    DiagnosticStatus_& status = out.status().emplace_back();
    const bool fault = state.mode == PlannerState::Mode::kFull || state.lost_replies > 0;
    status.level(fault ? level::WARN_ : level::OK_);
    status.name(node + ": planner");
    status.message(to_string(state.mode));
    status.hardware_id(state.planner_id);
    add(status, "version", state.version);
    add(status, "config_hash", state.config_hash);
    add(status, "queue_length", std::to_string(state.queue_length));
    add(status, "queue_capacity", std::to_string(state.queue_capacity));
    add(status, "workers", std::to_string(state.workers));
    add(status, "busy_workers", std::to_string(state.busy_workers));
    add(status, "latency_p50_ms", std::to_string(state.latency_p50_ms));
    add(status, "latency_p95_ms", std::to_string(state.latency_p95_ms));
    add(status, "requests", std::to_string(state.requests));
    for (std::size_t i = 0; i < state.replies.size(); ++i) {
        const auto verdict = static_cast<PlanStatus>(i);
        add(status, to_string(verdict), std::to_string(state.replies[i]));
    }
    add(status, "lost_replies", std::to_string(state.lost_replies));
    add(status, "rejected_payloads", std::to_string(state.rejected_payloads));
    add(status, "restarts", std::to_string(state.restarts));
    add(status, "abandoned_plans", std::to_string(state.abandoned_plans));
    add(status, "peers", std::to_string(state.peers));
    add(status, "held_requests", std::to_string(state.held_requests));
    add(status, "taken_over", std::to_string(state.taken_over));
    add(status, "grippers", joined(state.grippers));
    return out;
}

}  // namespace dds
}  // namespace graspd
