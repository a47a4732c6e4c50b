#include "support/plan_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <string>

#include "graspd/planner/planner.hpp"
#include "support/plan_samples.hpp"
#include "support/shapes.hpp"

namespace graspd::test {
namespace {

using Eigen::Vector3d;

double angle_between(const Vector3d& a, const Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// parallel_85's pads stand 115 mm before its flange, whatever the opening.
constexpr double kPads_m = 0.115;

void expect_frames(const Grasp& grasp, const PlannerConfig& config) {
    const Eigen::Matrix3d R = grasp.X_FG.linear();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-9);
    const Vector3d z = R.col(2);
    const double approach_m = config.manipulability.approach_distance_m;
    EXPECT_LT((grasp.approach.direction_F - z).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(grasp.approach.distance_m, approach_m);
    EXPECT_LT((grasp.X_FG_pregrasp.linear() - R).norm(), 1e-9);
    const Vector3d before = grasp.X_FG.translation() - approach_m * z;
    EXPECT_LT((grasp.X_FG_pregrasp.translation() - before).norm(), 1e-9);
    EXPECT_LT((grasp.X_FH.linear() - R).norm(), 1e-9);
    EXPECT_LT((grasp.X_FH.translation() - (grasp.X_FG.translation() - kPads_m * z)).norm(), 1e-9);
    EXPECT_NEAR(grasp.retreat.direction_F.norm(), 1.0, 1e-9);
    EXPECT_GT(grasp.retreat.distance_m, 0.0);
}

void expect_contacts(const Grasp& grasp, const Gripper& gripper, const PlannerConfig& config) {
    EXPECT_GT(grasp.width_m, gripper.min_width_m);
    EXPECT_GT(grasp.open_width_m, grasp.width_m);
    EXPECT_LE(grasp.open_width_m, gripper.max_width_m + 1e-12);
    for (const std::size_t i : {0, 1}) {
        const double side = i == 0 ? -1.0 : 1.0;
        const Vector3d p_G = grasp.X_FG.inverse() * grasp.contacts[i].point_F;
        // A pad's touch is a mean of places up to max_depth_m behind the first one.
        const double behind_m = 0.5 * grasp.width_m - side * p_G.x();
        EXPECT_GE(behind_m, -1e-9);
        EXPECT_LE(behind_m, config.local_cloud.max_depth_m + 1e-9);
        EXPECT_LE(std::abs(p_G.y()), 0.5 * gripper.finger_width_m);
        EXPECT_LE(std::abs(p_G.z()), gripper.tip_offset_m);
        const Vector3d normal_G = grasp.X_FG.linear().transpose() * grasp.contacts[i].normal_F;
        EXPECT_NEAR(normal_G.norm(), 1.0, 1e-9);
        EXPECT_GT(side * normal_G.x(), 0.0);
    }
}

void expect_merits(const Grasp& grasp, const PlanRequest& request, const PlannerConfig& config) {
    const Vector3d line = grasp.contacts[1].point_F - grasp.contacts[0].point_F;
    const double worst = std::max(angle_between(line, -grasp.contacts[0].normal_F),
                                  angle_between(line, grasp.contacts[1].normal_F));
    EXPECT_NEAR(grasp.min_friction, std::tan(worst), 1e-6);
    EXPECT_LE(grasp.min_friction, request.options.friction);
    EXPECT_GE(grasp.beta_rad, 0.0);
    EXPECT_LT(grasp.beta_rad, std::numbers::pi);
    EXPECT_GE(grasp.clearance_m, request.options.min_clearance_m);
    EXPECT_GE(grasp.clearance_m, 0.0);
    EXPECT_LE(grasp.clearance_m, config.search.most_clearance_m);
    if (request.options.mass_kg) {
        const double spare = 2.0 * (request.options.friction - grasp.min_friction);
        EXPECT_NEAR(grasp.min_force_N, *request.options.mass_kg * 9.81 / spare, 1e-9);
    }
    if (grasp.tolerance) {
        EXPECT_GE(grasp.tolerance->shift_m, 0.0);
        EXPECT_LE(2.0 * grasp.tolerance->shift_m, grasp.open_width_m - grasp.width_m + 1e-12);
        EXPECT_LE(grasp.tolerance->shift_m, config.search.tolerance_shift_m);
        EXPECT_LE(grasp.tolerance->turn_rad, config.search.tolerance_turn_rad);
    }
    double sum = 0.0;
    for (const ScoreTerm& term : grasp.terms) sum += term.value;
    EXPECT_EQ(grasp.terms.size(), 8U);
    EXPECT_NEAR(grasp.score, 1.0 / (1.0 + std::exp(-sum)), 1e-9);
}

void expect_source(const Grasp& grasp, const PlanRequest& request) {
    const unsigned wanted = request.options.sources == 0 ? 7U : request.options.sources;
    EXPECT_NE(wanted & grasp.source, 0U) << to_string(grasp.source);
    EXPECT_EQ(grasp.concavity_index < 0, grasp.source == kWholeObject);
    EXPECT_EQ(grasp.concavity_depth_m > 0.0, grasp.source != kWholeObject);
}

std::string strategy_of(const PlanReply& reply) {
    const auto whole = std::ranges::count(reply.grasps, kWholeObject, &Grasp::source);
    if (reply.grasps.empty()) return "";
    if (whole == 0) return "concavity";
    return whole == std::ssize(reply.grasps) ? "whole_object" : "mixed";
}

bool same_bits(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return a.matrix() == b.matrix();
}

/// The counts of a reply's rejections, each to be asked for once.
class Fallen {
public:
    explicit Fallen(const PlanReply& reply) {
        for (const RejectionCount& row : reply.report.rejections) {
            EXPECT_GT(row.count, 0U) << row.reason;
            EXPECT_TRUE(counts_.emplace(row.reason, row.count).second) << row.reason << " twice";
        }
    }
    std::uint64_t by(const std::string& reason) {
        const auto found = counts_.extract(reason);
        return found.empty() ? 0 : found.mapped();
    }
    /// finger_hits_object, approach_hits_plane, ...
    std::uint64_t by_hitting() {
        std::uint64_t sum = 0;
        for (auto row = counts_.begin(); row != counts_.end();) {
            const bool hits = row->first.find("_hits_") != std::string::npos;
            if (hits) sum += row->second;
            row = hits ? counts_.erase(row) : std::next(row);
        }
        return sum;
    }
    /// Reasons that nobody has asked for.
    std::string rest() const {
        std::string names;
        for (const auto& [reason, count] : counts_) names += reason + " ";
        return names;
    }

private:
    std::map<std::string, std::uint64_t> counts_;
};

}  // namespace

PlanRequest request_for(TriangleMesh mesh_O) {
    PlanRequest request;
    request.request_id = "test";
    request.frame_id = "world";
    request.object_O = std::move(mesh_O);
    request.grippers.emplace_back();  // the struct's defaults are those of parallel_85
    request.grippers.back().name = "parallel_85";
    return request;
}

TriangleMesh lopsided(std::size_t faces) {
    const auto filled = [](int i, int j, int k) {
        if (k == 0) return true;            // the plate, 20 high
        if (i == 0 && j == 0) return true;  // a boss at one corner, 50 high
        return k == 1 && i == 2 && j == 0;  // a lower one at another, 32 high
    };
    return grid_solid(
        {std::vector<double>{-0.03, -0.01, 0.018, 0.04}, std::vector<double>{-0.02, 0.005, 0.02},
         std::vector<double>{0.0, 0.02, 0.032, 0.05}},
        filled, faces);
}

void expect_consistent(const PlanReply& reply, const PlanRequest& request,
                       const PlannerConfig& config) {
    EXPECT_EQ(reply.request_id, request.request_id);
    EXPECT_EQ(reply.frame_id, request.frame_id);
    EXPECT_EQ(reply.object_key.size(), 32U);
    EXPECT_EQ(reply.strategy, strategy_of(reply));
    EXPECT_LE(reply.grasps.size(), request.options.max_grasps);
    EXPECT_LE(reply.report.near_misses.size(), 3U);
    if (reply.status == PlanStatus::kOk) {
        EXPECT_FALSE(reply.grasps.empty());
        EXPECT_EQ(reply.message, "");
    } else {
        EXPECT_NE(reply.message, "");
    }
    for (std::size_t i = 0; i < reply.grasps.size(); ++i) {
        SCOPED_TRACE("grasp " + std::to_string(i));
        const Grasp& grasp = reply.grasps[i];
        expect_frames(grasp, config);
        expect_contacts(grasp, request.grippers.front(), config);
        expect_merits(grasp, request, config);
        expect_source(grasp, request);
        EXPECT_EQ(grasp.gripper_name, request.grippers.front().name);
        if (i > 0) {
            EXPECT_GE(reply.grasps[i - 1].score, grasp.score);
        }
    }
}

const StageReport* stage_of(const PlanReply& reply, const std::string& name) {
    const auto found = std::ranges::find(reply.report.stages, name, &StageReport::name);
    return found == reply.report.stages.end() ? nullptr : &*found;
}

std::uint64_t out_of(const PlanReply& reply, const std::string& stage) {
    const StageReport* found = stage_of(reply, stage);
    return found == nullptr ? 0 : found->out;
}

void expect_counts_add_up(const PlanReply& reply, const PlannerConfig& config) {
    const auto in = [&](const char* name) {
        const StageReport* stage = stage_of(reply, name);
        return stage == nullptr ? 0 : stage->in;
    };
    const auto out = [&](const char* name) { return out_of(reply, name); };
    Fallen fallen(reply);
    const std::uint64_t axes = out("grasp/grasp_candidates") + out("grasp/opposite_candidates");
    const std::uint64_t tried = in("planner/find_poses");
    EXPECT_EQ(axes, in("planner/order_axes") + fallen.by("axis_source_unwanted"));
    EXPECT_EQ(in("planner/order_axes") - out("planner/order_axes"),
              fallen.by("axis_no_contact") + fallen.by("axis_leans") + fallen.by("axis_too_wide"));
    EXPECT_EQ(out("planner/order_axes") - tried,
              fallen.by("axis_similar") + fallen.by("axis_surplus"));
    const std::uint64_t open = out("planner/find_poses");
    EXPECT_EQ(tried * config.search.approaches * config.search.insertions - open,
              fallen.by("outside_approach_cones") + fallen.by("palm_line_blocked") +
                  fallen.by("finger_line_blocked"));
    const std::uint64_t reached = open - fallen.by("pose_surplus");
    // The hand is asked twice: at the pose before it closes, and about its whole motion.
    const std::uint64_t closed = in("grasp/local_cloud"), held = out("grasp/force_balance");
    const std::uint64_t graded = out("collision/manipulability");
    EXPECT_EQ(in("collision/manipulability"), reached + held);
    EXPECT_EQ((reached - closed) + (held - graded), fallen.by("too_wide") + fallen.by_hitting());
    const std::uint64_t unpressed = in("grasp/contact_patch") - out("grasp/contact_patch");
    EXPECT_EQ(closed - out("grasp/local_cloud") + unpressed,
              fallen.by("no_contact") + fallen.by("too_thin"));
    EXPECT_EQ(out("grasp/local_cloud") - held,
              fallen.by("contact_too_small") + fallen.by("side_not_straight") + fallen.by("slips"));
    EXPECT_EQ(in("grasp/contact_patch"), graded);
    const std::uint64_t pressed = out("grasp/contact_patch");
    EXPECT_EQ(in("collision/gripper_collision"), pressed);
    const std::uint64_t clear = out("collision/gripper_collision");
    EXPECT_EQ(pressed - clear, fallen.by("clearance"));
    EXPECT_EQ(clear - reply.grasps.size(), fallen.by("duplicate") + fallen.by("surplus"));
    EXPECT_EQ(fallen.rest(), "");
}

PlanReply planned(const PlanRequest& request, const PlannerConfig& config) {
    PlanReply reply = plan(request, config);
    expect_consistent(reply, request, config);
    if (reply.status == PlanStatus::kOk || reply.status == PlanStatus::kNoGrasp) {
        expect_counts_add_up(reply, config);
    }
    return reply;
}

void expect_identical(const PlanReply& a, const PlanReply& b) {
    PlanReply timeless_a = a, timeless_b = b;
    for (PlanReply* reply : {&timeless_a, &timeless_b}) {
        for (StageReport& stage : reply->report.stages) stage.ms = 0.0;
    }
    expect_same(timeless_a, timeless_b);
    ASSERT_EQ(a.grasps.size(), b.grasps.size());
    for (std::size_t i = 0; i < a.grasps.size(); ++i) {
        EXPECT_TRUE(same_bits(a.grasps[i].X_FG, b.grasps[i].X_FG)) << "grasp " << i;
        EXPECT_TRUE(same_bits(a.grasps[i].X_FG_pregrasp, b.grasps[i].X_FG_pregrasp));
        EXPECT_TRUE(same_bits(a.grasps[i].X_FH, b.grasps[i].X_FH));
    }
    ASSERT_EQ(a.report.near_misses.size(), b.report.near_misses.size());
    for (std::size_t i = 0; i < a.report.near_misses.size(); ++i) {
        EXPECT_TRUE(same_bits(a.report.near_misses[i].X_FG, b.report.near_misses[i].X_FG));
    }
}

std::uint64_t rejections_of(const PlanReply& reply, const std::string& reason) {
    const auto found = std::ranges::find(reply.report.rejections, reason, &RejectionCount::reason);
    return found == reply.report.rejections.end() ? 0 : found->count;
}

}  // namespace graspd::test
