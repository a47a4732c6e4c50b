#include "compare_replies.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "graspd/base/geometry.hpp"
#include "write_json.hpp"

namespace graspd::cli {
namespace {

std::string shown(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", value);
    return digits;
}

std::string shown(const Eigen::Vector3d& v) {
    return shown(v.x()) + " " + shown(v.y()) + " " + shown(v.z());
}

/// The differences found so far.
struct Comparison {
    std::vector<ReplyDifference> found;

    void texts(const std::string& what, const std::string& a, const std::string& b) {
        if (a != b) found.push_back({what, a, b});
    }
    void numbers(const std::string& what, double a, double b) {
        const bool same = a == b || (std::isnan(a) && std::isnan(b));
        if (!same) found.push_back({what, shown(a), shown(b) + " (" + shown(b - a) + ")"});
    }
    void counts(const std::string& what, std::uint64_t a, std::uint64_t b) {
        texts(what, std::to_string(a), std::to_string(b));
    }
    void poses(const std::string& what, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
        if (a.translation() != b.translation()) {
            const double off_mm = 1e3 * (a.translation() - b.translation()).norm();
            found.push_back({what + ": position", shown(a.translation()),
                             shown(b.translation()) + " (" + shown(off_mm) + " mm)"});
        }
        if (a.linear() != b.linear()) {
            const Eigen::AngleAxisd turn(a.linear().transpose() * b.linear());
            found.push_back(
                {what + ": rotation", "",
                 "turned by " + shown(turn.angle() * 180.0 / std::numbers::pi) + " degrees"});
        }
    }
};

void compare_grasps(const PlanReply& a, const PlanReply& b, Comparison& to) {
    to.counts("number of grasps", a.grasps.size(), b.grasps.size());
    for (std::size_t i = 0; i < std::min(a.grasps.size(), b.grasps.size()); ++i) {
        const std::string rank = "grasp " + std::to_string(i + 1);
        const Grasp& of_a = a.grasps[i];
        const Grasp& of_b = b.grasps[i];
        to.poses(rank, of_a.X_FG, of_b.X_FG);
        to.numbers(rank + ": score", of_a.score, of_b.score);
        to.numbers(rank + ": width", of_a.width_m, of_b.width_m);
        to.numbers(rank + ": clearance", of_a.clearance_m, of_b.clearance_m);
        to.texts(rank + ": gripper", of_a.gripper_name, of_b.gripper_name);
        to.texts(rank + ": source", to_string(of_a.source), to_string(of_b.source));
    }
}

/// Rows of a report by their name: a row that one side lacks counts as "none".
template <class Rows, class Name, class Value>
void compare_rows(const std::string& what, const Rows& a, const Rows& b, Name name, Value value,
                  Comparison& to) {
    std::map<std::string, std::pair<std::string, std::string>> both;
    for (const auto& row : a) both[name(row)].first += value(row);
    for (const auto& row : b) both[name(row)].second += value(row);
    const auto or_none = [](const std::string& text) { return text.empty() ? "none" : text; };
    for (const auto& [key, values] : both) {
        to.texts((what + ' ').append(key), or_none(values.first), or_none(values.second));
    }
}

void compare_reports(const PlanReport& a, const PlanReport& b, Comparison& to) {
    compare_rows(
        "finding", a.findings, b.findings, [](const Finding& f) { return f.code; },
        [](const Finding& f) { return shown(f.value) + " " + f.detail; }, to);
    compare_rows(
        "rejections by", a.rejections, b.rejections,
        [](const RejectionCount& r) { return r.reason; },
        [](const RejectionCount& r) { return std::to_string(r.count); }, to);
    compare_rows(
        "stage", a.stages, b.stages, [](const StageReport& s) { return s.name; },
        [](const StageReport& s) {
            return std::to_string(s.in) + " in, " + std::to_string(s.out) + " out";
        },
        to);
    to.texts("suggestion", a.suggestion, b.suggestion);
}

std::string without_times(PlanReply reply) {
    for (StageReport& stage : reply.report.stages) stage.ms = 0.0;
    return write_json(reply, {}, {});
}

}  // namespace

std::vector<ReplyDifference> compare_replies(const PlanReply& recorded, const PlanReply& replayed) {
    Comparison comparison;
    comparison.texts("status", to_string(recorded.status), to_string(replayed.status));
    comparison.texts("message", recorded.message, replayed.message);
    comparison.texts("strategy", recorded.strategy, replayed.strategy);
    comparison.texts("object_key", recorded.object_key, replayed.object_key);
    compare_grasps(recorded, replayed, comparison);
    compare_reports(recorded.report, replayed.report, comparison);
    // What has no line of its own above, such as the terms of a score or the near misses.
    if (comparison.found.empty() && without_times(recorded) != without_times(replayed)) {
        comparison.found.push_back({"details of the grasps or the report", "", "differ"});
    }
    return std::move(comparison.found);
}

}  // namespace graspd::cli
