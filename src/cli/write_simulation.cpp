#include "write_simulation.hpp"

#include <numbers>

#include <nlohmann/json.hpp>

#include "text_table.hpp"

namespace graspd::cli {

std::string write_simulation_json(const std::string& plan_json, const SimulationRun& run) {
    auto json = nlohmann::ordered_json::parse(plan_json);
    const SimulationResult& result = run.result;
    json["simulation"] = {{"rank", run.rank},
                          {"verdict", to_string(result.verdict)},
                          {"phase", to_string(result.phase)},
                          {"detail", result.detail},
                          {"mass", run.config.mass_kg},
                          {"grip_force", run.config.grip_force_N},
                          {"friction", run.config.friction},
                          {"width", result.width_m},
                          {"close_shift", result.close_shift_m},
                          {"close_turn_rad", result.close_turn_rad},
                          {"shift", result.shift_m},
                          {"turn_rad", result.turn_rad}};
    return json.dump(2) + "\n";
}

std::string write_simulation_line(const PlanReply& reply, const SimulationRun& run) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    const SimulationResult& result = run.result;
    std::string text = reply.request_id + ": " + to_string(result.verdict) + ": grasp " +
                       std::to_string(run.rank) + " of " + std::to_string(reply.grasps.size()) +
                       " (score " + fixed(reply.grasps[run.rank - 1].score, 3) + "), " +
                       fixed(run.config.mass_kg, 3) + " kg, " + fixed(run.config.grip_force_N, 1) +
                       " N a finger, friction " + fixed(run.config.friction, 2) + ": " +
                       result.detail;
    const bool held =
        result.verdict == GraspVerdict::kHolds || result.verdict == GraspVerdict::kSlips;
    if (held) {
        text += ", moved " + fixed(result.shift_m, 1, kMillimetres) + " mm and " +
                fixed(result.turn_rad, 1, kDegrees) + " degrees in the hand";
    }
    return text + "\n";
}

}  // namespace graspd::cli
