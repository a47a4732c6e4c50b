#include "write_table.hpp"

#include <numbers>

#include "text_table.hpp"
#include "write_findings.hpp"

namespace graspd::cli {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string triple(const Eigen::Vector3d& vector, int decimals, double factor) {
    std::string text;
    for (const double value : vector) {
        const std::string number = fixed(value, decimals, factor);
        text += (text.empty() ? "" : " ") +
                std::string(number.size() < 7 ? 7 - number.size() : 0, ' ') + number;
    }
    return text;
}

std::string headline(const PlanReply& reply, std::span<const Gripper> grippers,
                     const ResultOrigin& origin) {
    std::string text = reply.request_id + ": " + to_string(reply.status) + ", " +
                       std::to_string(reply.grasps.size()) + " grasps";
    if (!reply.strategy.empty()) text += ", strategy " + reply.strategy;
    for (const Gripper& gripper : grippers) text += ", " + gripper.name;
    text += ", " + fixed(origin.total_ms, 1) + " ms\n";
    if (!reply.message.empty()) text += reply.message + "\n";
    return text;
}

std::string grasp_rows(const PlanReply& reply) {
    if (reply.grasps.empty()) return "";
    TextTable table;
    table.rows.push_back({"rank", "score", "width", "open", "clear", "depth", "beta",
                          "mu>=", "source", "TCP x y z [mm]", "approach x y z"});
    table.align_left = {false, false, false, false, false, false, false, false, true};
    for (const Grasp& grasp : reply.grasps) {
        table.rows.push_back(
            {std::to_string(table.rows.size()), fixed(grasp.score, 3),
             fixed(grasp.width_m, 1, kMillimetres), fixed(grasp.open_width_m, 1, kMillimetres),
             fixed(grasp.clearance_m, 1, kMillimetres),
             fixed(grasp.concavity_depth_m, 1, kMillimetres), fixed(grasp.beta_rad, 1, kDegrees),
             fixed(grasp.min_friction, 2), to_string(grasp.source),
             triple(grasp.X_FG.translation(), 1, kMillimetres),
             triple(grasp.X_FG.linear().col(2), 2, 1.0)});
    }
    return "\n" + print_table(table) +
           "width, open, clear, depth in mm, beta in degrees, poses in frame \"" + reply.frame_id +
           "\"; approach is Gz\n";
}

std::string reason_rows(const PlanReport& report) {
    if (report.rejections.empty()) return "";
    TextTable table{{{"rejected because", "candidates"}}, {true, false}};
    for (const RejectionCount& row : report.rejections) {
        table.rows.push_back({row.reason, std::to_string(row.count)});
    }
    return "\n" + print_table(table);
}

std::string miss_rows(const PlanReport& report) {
    if (report.near_misses.empty()) return "";
    TextTable table{{{"nearest misses", "by", "TCP x y z [mm]"}}, {true, false, true}};
    for (const NearMiss& miss : report.near_misses) {
        const bool length = miss.unit == "m";
        const bool angle = miss.unit == "rad";
        const double factor = length ? kMillimetres : angle ? kDegrees : 1.0;
        const std::string unit = length ? " mm" : angle ? " deg" : "";
        table.rows.push_back({miss.reason, fixed(miss.margin, 2, factor) + unit,
                              triple(miss.X_FG.translation(), 1, kMillimetres)});
    }
    return "\n" + print_table(table);
}

std::string stage_rows(const PlanReport& report) {
    if (report.stages.empty()) return "";
    TextTable table{{{"stage", "ms", "in", "out"}}, {true}};
    for (const StageReport& stage : report.stages) {
        table.rows.push_back(
            {stage.name, fixed(stage.ms, 2), std::to_string(stage.in), std::to_string(stage.out)});
    }
    return "\n" + print_table(table);
}

}  // namespace

std::string write_table(const PlanReply& reply, std::span<const Gripper> grippers,
                        const ResultOrigin& origin) {
    std::string text = headline(reply, grippers, origin) + grasp_rows(reply);
    if (reply.grasps.empty()) text += reason_rows(reply.report) + miss_rows(reply.report);
    if (!reply.report.suggestion.empty()) text += "\nsuggestion: " + reply.report.suggestion + "\n";
    return text + finding_rows(reply.report.findings) + stage_rows(reply.report);
}

std::string write_table(std::span<const Gripper> grippers) {
    TextTable table{{{"gripper [mm]", "opening", "finger length", "width", "thickness",
                      "tip offset", "palm width", "height", "depth"}},
                    {true}};
    for (const Gripper& gripper : grippers) {
        table.rows.push_back({gripper.name,
                              fixed(gripper.min_width_m, 1, kMillimetres) + ".." +
                                  fixed(gripper.max_width_m, 1, kMillimetres),
                              fixed(gripper.finger_length_m, 1, kMillimetres),
                              fixed(gripper.finger_width_m, 1, kMillimetres),
                              fixed(gripper.finger_thickness_m, 1, kMillimetres),
                              fixed(gripper.tip_offset_m, 1, kMillimetres),
                              fixed(gripper.palm_width_m, 1, kMillimetres),
                              fixed(gripper.palm_height_m, 1, kMillimetres),
                              fixed(gripper.palm_depth_m, 1, kMillimetres)});
    }
    return print_table(table);
}

}  // namespace graspd::cli
