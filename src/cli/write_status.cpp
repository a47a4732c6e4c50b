#include "write_status.hpp"

#include <nlohmann/json.hpp>

#include "graspd/planner/plan_types.hpp"
#include "text_table.hpp"

namespace graspd::cli {
namespace {

nlohmann::ordered_json replies_of(const PlannerState& state) {
    nlohmann::ordered_json out;
    for (std::size_t i = 0; i < state.replies.size(); ++i) {
        out[to_string(static_cast<PlanStatus>(i))] = state.replies[i];
    }
    return out;
}

std::string share(std::uint64_t part, std::uint64_t whole) {
    return std::to_string(part) + "/" + std::to_string(whole);
}

}  // namespace

std::string write_status_table(std::span<const PlannerState> planners) {
    TextTable table;
    table.align_left = {true, true};
    table.rows.push_back({"planner", "state", "queue", "busy", "requests", "p50_ms", "p95_ms",
                          "lost", "restarts", "abandoned", "objects", "version"});
    for (const PlannerState& state : planners) {
        table.rows.push_back({state.planner_id, to_string(state.mode),
                              share(state.queue_length, state.queue_capacity),
                              share(state.busy_workers, state.workers),
                              std::to_string(state.requests), fixed(state.latency_p50_ms, 1),
                              fixed(state.latency_p95_ms, 1), std::to_string(state.lost_replies),
                              std::to_string(state.restarts), std::to_string(state.abandoned_plans),
                              std::to_string(state.cached_objects), state.version});
    }
    return print_table(table);
}

std::string write_status_json(std::span<const PlannerState> planners) {
    nlohmann::ordered_json out = {{"schema", "graspd/1"},
                                  {"planners", nlohmann::ordered_json::array()}};
    for (const PlannerState& state : planners) {
        out["planners"].push_back({{"planner_id", state.planner_id},
                                   {"version", state.version},
                                   {"config_hash", state.config_hash},
                                   {"state", to_string(state.mode)},
                                   {"queue_length", state.queue_length},
                                   {"queue_capacity", state.queue_capacity},
                                   {"workers", state.workers},
                                   {"busy_workers", state.busy_workers},
                                   {"cached_objects", state.cached_objects},
                                   {"latency_p50_ms", state.latency_p50_ms},
                                   {"latency_p95_ms", state.latency_p95_ms},
                                   {"requests", state.requests},
                                   {"replies", replies_of(state)},
                                   {"lost_replies", state.lost_replies},
                                   {"rejected_payloads", state.rejected_payloads},
                                   {"restarts", state.restarts},
                                   {"abandoned_plans", state.abandoned_plans},
                                   {"grippers", state.grippers}});
    }
    return out.dump(2) + "\n";
}

}  // namespace graspd::cli
