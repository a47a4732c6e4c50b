#include "write_json.hpp"

#include <algorithm>

#include "json_values.hpp"
#include "write_findings.hpp"

namespace graspd::cli {
namespace {

using cli::json_of;  // of vectors, beside those below

constexpr const char* kSchema = "graspd/1";
constexpr const char* kConvention = "tcp_z_approach_x_closing";

Json json_of(const Eigen::Isometry3d& pose) {
    Json rotation = Json::array();
    for (Eigen::Index row = 0; row < 3; ++row) {
        for (Eigen::Index column = 0; column < 3; ++column) {
            rotation.push_back(pose.linear()(row, column));
        }
    }
    Eigen::Quaterniond turn(pose.linear());
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();  // q and -q are the same rotation
    return {{"position", json_of(Eigen::Vector3d(pose.translation()))},
            {"rotation", std::move(rotation)},
            {"quaternion", {turn.x(), turn.y(), turn.z(), turn.w()}}};
}

Json json_of(const LinearMotion& motion) {
    return {{"direction", json_of(motion.direction_F)}, {"distance", motion.distance_m}};
}

Json json_of(const Gripper& gripper) {
    Json travel = Json::array();
    for (const PadTravel& row : gripper.pad_travel) {
        travel.push_back({{"opening", row.opening_m}, {"pad_z", row.pad_z_m}});
    }
    return {{"name", gripper.name},
            {"max_width", gripper.max_width_m},
            {"finger_length", gripper.finger_length_m},
            {"finger_width", gripper.finger_width_m},
            {"finger_thickness", gripper.finger_thickness_m},
            {"palm_depth", gripper.palm_depth_m},
            {"palm_width", gripper.palm_width_m},
            {"palm_height", gripper.palm_height_m},
            {"tip_offset", gripper.tip_offset_m},
            {"min_width", gripper.min_width_m},
            {"palm_z", gripper.palm_z_m},
            {"closing_yaw", gripper.closing_yaw_rad},
            {"pad_travel", std::move(travel)}};
}

Json json_of(const Grasp& grasp, std::size_t rank) {
    Json out = {{"rank", rank}};
    out.update(json_of(grasp.X_FG));
    out["width"] = grasp.width_m;
    out["open_width"] = grasp.open_width_m;
    out["score"] = grasp.score;
    out["terms"] = Json::object();
    for (const ScoreTerm& term : grasp.terms) out["terms"][term.name] = term.value;
    out["approach"] = json_of(grasp.approach);
    out["retreat"] = json_of(grasp.retreat);
    out["contacts"] = Json::array();
    for (const Contact& contact : grasp.contacts) {
        out["contacts"].push_back(
            {{"point", json_of(contact.point_F)}, {"normal", json_of(contact.normal_F)}});
    }
    out["clearance"] = grasp.clearance_m;
    out["concavity"] = {{"index", grasp.concavity_index}, {"depth", grasp.concavity_depth_m}};
    out["pregrasp_pose"] = json_of(grasp.X_FG_pregrasp);
    out["hand_pose"] = json_of(grasp.X_FH);
    out["beta_rad"] = grasp.beta_rad;
    out["min_friction"] = grasp.min_friction;
    out["min_force"] = grasp.min_force_N;
    out["tolerance"] = nullptr;
    if (grasp.tolerance) {
        out["tolerance"] = {{"shift", grasp.tolerance->shift_m},
                            {"turn", grasp.tolerance->turn_rad}};
    }
    out["source"] = to_string(grasp.source);
    out["gripper"] = grasp.gripper_name;
    return out;
}

Json json_of(const PlanReport& report) {
    Json stages = Json::array();
    for (const StageReport& stage : report.stages) {
        stages.push_back(
            {{"name", stage.name}, {"ms", stage.ms}, {"in", stage.in}, {"out", stage.out}});
    }
    Json rejections = Json::object();
    for (const RejectionCount& row : report.rejections) rejections[row.reason] = row.count;
    Json near_misses = Json::array();
    for (const NearMiss& miss : report.near_misses) {
        Json entry = {{"reason", miss.reason}, {"margin", miss.margin}, {"unit", miss.unit}};
        entry.update(json_of(miss.X_FG));
        near_misses.push_back(std::move(entry));
    }
    return {{"stages", std::move(stages)},
            {"rejections", std::move(rejections)},
            {"near_misses", std::move(near_misses)},
            {"findings", findings_json(report.findings)},
            {"suggestion", report.suggestion}};
}

/// The gripper that the result is about.
Json gripper_of(const PlanReply& reply, std::span<const Gripper> grippers) {
    if (grippers.empty()) return nullptr;
    auto chosen = grippers.begin();
    if (!reply.grasps.empty()) {
        const auto named =
            std::ranges::find(grippers, reply.grasps.front().gripper_name, &Gripper::name);
        if (named != grippers.end()) chosen = named;
    }
    return json_of(*chosen);
}

/// Text from a request may be no UTF-8; such bytes become U+FFFD.
std::string dumped(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string write_json(const PlanReply& reply, std::span<const Gripper> grippers,
                       const ResultOrigin& origin) {
    Json grasps = Json::array();
    for (const Grasp& grasp : reply.grasps) grasps.push_back(json_of(grasp, grasps.size() + 1));
    const Json json = {
        {"schema", kSchema},
        {"request_id", reply.request_id},
        {"status", to_string(reply.status)},
        {"message", reply.message},
        {"frame_id", reply.frame_id},
        {"strategy", reply.strategy},
        {"convention", kConvention},
        {"object_key", reply.object_key},
        {"gripper", gripper_of(reply, grippers)},
        {"grasps", std::move(grasps)},
        {"report", json_of(reply.report)},
        {"planner", {{"version", origin.version}, {"config_hash", origin.config_hash}}},
        {"timings_ms", {{"total", origin.total_ms}}}};
    return dumped(json);
}

std::string write_json(std::span<const Gripper> grippers) {
    Json list = Json::array();
    for (const Gripper& gripper : grippers) list.push_back(json_of(gripper));
    return dumped({{"schema", kSchema}, {"grippers", std::move(list)}});
}

}  // namespace graspd::cli
