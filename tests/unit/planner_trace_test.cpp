// What plan() tells of its way. Counts are held against the reply's own; shapes are worked by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "graspd/planner/planner.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::out_of;

struct TracedPlan {
    PlanReply reply;
    PlanTrace trace;
};
TracedPlan traced(const PlanRequest& request, const StopQuery& stop = {}) {
    TracedPlan plan;
    plan.reply = graspd::plan(request, {}, stop, &plan.trace);
    return plan;
}

PlanRequest hourglass() {
    return test::request_for(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 2000));
}

/// Plane, clearance, cone, little friction and two grippers: every kind of rejection.
PlanRequest demanding() {
    PlanRequest request = test::request_for(test::cup(0.045, 0.09, 0.004, 2000));
    request.support_plane = SupportPlane{Vector3d::UnitZ(), 0.0};
    request.approach_cones = {{-Vector3d::UnitZ(), 0.9}};
    request.options.min_clearance_m = 0.003;
    request.options.friction = 0.2;
    request.options.max_grasps = 2;
    request.options.sources = kWall | kBoundary;
    request.grippers.push_back(request.grippers.front());
    request.grippers.back().name = "narrow";
    request.grippers.back().max_width_m = 0.03;
    return request;
}

std::map<std::string, std::uint64_t> counts_of(const PlanTrace& trace) {
    std::map<std::string, std::uint64_t> counts;
    for (const TracedCandidate& candidate : trace.candidates) ++counts[candidate.reason];
    return counts;
}

void expect_counts_of_the_reply(const TracedPlan& plan) {
    auto counts = counts_of(plan.trace);
    EXPECT_EQ(counts[""], plan.reply.grasps.size());
    counts.erase("");
    for (const RejectionCount& row : plan.reply.report.rejections) {
        EXPECT_EQ(counts[row.reason], row.count) << row.reason;
    }
    EXPECT_EQ(counts.size(), plan.reply.report.rejections.size());
}

TEST(PlanTrace, HasAsManyCandidatesOfEachReasonAsTheReplyCounts) {
    for (const PlanRequest& request : {hourglass(), demanding()}) {
        const TracedPlan plan = traced(request);
        EXPECT_GT(plan.reply.report.rejections.size(), 5U);
        expect_counts_of_the_reply(plan);
    }
}

// A stopped plan drops the round under way, from the counts and from the trace alike.
TEST(PlanTrace, OfAStoppedPlanHoldsWhatCounts) {
    int questions = 0;
    const TracedPlan plan = traced(hourglass(), [&] { return ++questions > 6; });
    EXPECT_EQ(plan.reply.status, PlanStatus::kPartial);
    expect_counts_of_the_reply(plan);
}

TEST(PlanTrace, StageCountsAreThoseOfWhatItHolds) {
    const TracedPlan plan = traced(hourglass());
    ASSERT_EQ(plan.trace.searches.size(), 1U);
    const TracedSearch& search = plan.trace.searches.front();
    EXPECT_EQ(out_of(plan.reply, "mesh/condition_mesh"), plan.trace.object.mesh_P.faces.size());
    EXPECT_EQ(out_of(plan.reply, "mesh/sample_surface"), search.surface_P.samples.size());
    EXPECT_EQ(out_of(plan.reply, "regions/cluster_concavities"), search.concavities.size());
    std::size_t points = 0, steps = 0;
    for (const TracedBoundary& boundary : search.boundaries) {
        points += boundary.ordered_P.size();
        steps += boundary.steps_P.size();
    }
    EXPECT_EQ(out_of(plan.reply, "contour/order_boundary"), points);
    EXPECT_EQ(out_of(plan.reply, "grasp/step_points"), steps);
    const auto balanced = std::ranges::count_if(plan.trace.candidates, [](const auto& candidate) {
        return !std::isnan(candidate.beta_rad);
    });
    const auto* balance = test::stage_of(plan.reply, "grasp/force_balance");
    ASSERT_NE(balance, nullptr);
    EXPECT_LE(balanced, std::ssize(plan.trace.candidates));
    EXPECT_EQ(static_cast<std::uint64_t>(balanced),
              balance->in - counts_of(plan.trace)["side_not_straight"]);
}

// The reply's grasps stand at the end, in its order, where the reply says.
TEST(PlanTrace, EndsWithTheReplysGrasps) {
    for (const PlanRequest& request : {hourglass(), demanding()}) {
        const auto [reply, trace] = traced(request);
        ASSERT_FALSE(reply.grasps.empty());
        ASSERT_GT(trace.candidates.size(), reply.grasps.size());
        const std::size_t first = trace.candidates.size() - reply.grasps.size();
        for (std::size_t i = 0; i < reply.grasps.size(); ++i) {
            const TracedCandidate& candidate = trace.candidates[first + i];
            const Grasp& grasp = reply.grasps[i];
            EXPECT_EQ(candidate.reason, "");
            EXPECT_EQ(candidate.score, grasp.score);
            EXPECT_EQ(candidate.width_m, grasp.width_m);
            EXPECT_EQ(candidate.beta_rad, grasp.beta_rad);
            EXPECT_EQ(candidate.gripper_name, grasp.gripper_name);
            EXPECT_EQ(candidate.source, grasp.source);
            EXPECT_TRUE((trace.X_FP * candidate.X_PG).isApprox(grasp.X_FG, 1e-12));
        }
    }
}

// Plates of 60 x 48 x 10 mm on a neck of 20 x 20 x 30 mm: concavity is 0 on the hull, a box of
// 60 x 48 x 50 whose eight corners span it, and (60 - 20) / 2 = 20 mm or (48 - 20) / 2 = 14 mm at
// most on the neck's sides, so 20 at the most. The one concavity's salient samples lie between the
// plates, |z| <= 15 mm.
TEST(PlanTrace, ShowsAnHourglassAsItIs) {
    const auto [reply, trace] = traced(hourglass());
    const TracedObject& object = trace.object;
    ASSERT_EQ(object.concavity_m.size(), object.mesh_P.vertices.size());
    ASSERT_EQ(object.flag.size(), object.mesh_P.vertices.size());
    EXPECT_NEAR(object.volume_m3, 2 * 0.06 * 0.048 * 0.01 + 0.02 * 0.02 * 0.03, 1e-12);
    EXPECT_LT((trace.X_FP * object.center_of_mass_P).norm(), 1e-9);
    double largest = 0.0;
    for (std::size_t i = 0; i < object.concavity_m.size(); ++i) {
        const Vector3d p = (trace.X_FP * object.mesh_P.vertices[i]).cwiseAbs();
        const double to_hull = std::min({0.03 - p.x(), 0.024 - p.y(), 0.025 - p.z()});
        if (to_hull < 1e-9) {
            EXPECT_NEAR(object.concavity_m[i], 0.0, 1e-9);
        }
        largest = std::max(largest, object.concavity_m[i]);
    }
    EXPECT_NEAR(largest, 0.02, 1e-6);
    const auto is_corner = [&](std::uint32_t i) {
        const Vector3d place = (trace.X_FP * object.mesh_P.vertices[i]).cwiseAbs();
        return (place - Vector3d(0.03, 0.024, 0.025)).norm() < 1e-9;
    };
    EXPECT_EQ(std::ranges::count_if(object.hull, is_corner), 8);
    for (const std::uint32_t i : object.hull) EXPECT_NEAR(object.concavity_m[i], 0.0, 1e-9);
    const TracedSearch& search = trace.searches.front();
    ASSERT_FALSE(search.concavities.empty());
    for (const std::uint32_t i : search.concavities.front().salient) {
        const Vector3d point = trace.X_FP * search.surface_P.samples[i].point;
        EXPECT_LE(std::abs(point.z()), 0.015 + 1e-9);
    }
}

// Boundary and step points lie within the object's box.
TEST(PlanTrace, BoundariesRunThroughTheirRegion) {
    const auto [reply, trace] = traced(hourglass());
    const auto& boundaries = trace.searches.front().boundaries;
    ASSERT_FALSE(boundaries.empty());
    for (const TracedBoundary& boundary : boundaries) {
        ASSERT_GE(boundary.ordered_P.size(), 2U);
        EXPECT_GE(boundary.concavity, 0);
        EXPECT_LT(boundary.concavity, std::ssize(trace.searches.front().concavities));
        for (const auto* points : {&boundary.ordered_P, &boundary.steps_P}) {
            for (const Vector3d& point_P : *points) {
                const Vector3d point = (trace.X_FP * point_P).cwiseAbs();
                EXPECT_LE(point.x(), 0.03 + 1e-9);
                EXPECT_LE(point.y(), 0.024 + 1e-9);
                EXPECT_LE(point.z(), 0.025 + 1e-9);
            }
        }
    }
}

// Nothing of 100 x 120 x 140 fits between fingers that open by 85 mm: axes across it miss by at
// least 15 mm and the margin of the pads; no pose was ever tried, so no balance is known.
TEST(PlanTrace, SaysByHowMuchTheHandIsTooSmall) {
    const auto [reply, trace] = traced(test::request_for(test::box({0.10, 0.12, 0.14}, 500)));
    ASSERT_EQ(reply.status, PlanStatus::kNoGrasp);
    std::size_t wide = 0;
    for (const TracedCandidate& candidate : trace.candidates) {
        if (candidate.reason != "axis_too_wide") continue;
        ++wide;
        EXPECT_GE(candidate.margin, 0.015);
        EXPECT_LE(candidate.margin, std::hypot(0.10, 0.12, 0.14));
        EXPECT_EQ(candidate.unit, "m");
        EXPECT_GE(candidate.width_m, 0.10 - 1e-9);
        EXPECT_TRUE(std::isnan(candidate.beta_rad));
        EXPECT_TRUE(std::isnan(candidate.score));
    }
    EXPECT_GT(wide, 0U);
}

TEST(PlanTrace, ChangesNothingInTheReply) {
    for (PlanRequest request : {hourglass(), demanding()}) {
        request.options.want_suggestion = true;
        test::expect_identical(plan(request, {}), traced(request).reply);
    }
}

TEST(PlanTrace, IsTheSameAgain) {
    const PlanTrace a = traced(demanding()).trace, b = traced(demanding()).trace;
    ASSERT_EQ(a.candidates.size(), b.candidates.size());
    for (std::size_t i = 0; i < a.candidates.size(); ++i) {
        EXPECT_EQ(a.candidates[i].X_PG.matrix(), b.candidates[i].X_PG.matrix());
        EXPECT_EQ(a.candidates[i].reason, b.candidates[i].reason);
    }
}

TEST(PlanTrace, OfARefusedRequestIsEmpty) {
    PlanRequest request = hourglass();
    PlanTrace trace = traced(request).trace;
    request.options.friction = -1.0;
    EXPECT_EQ(plan(request, {}, {}, &trace).status, PlanStatus::kInvalidRequest);
    EXPECT_TRUE(trace.object.mesh_P.faces.empty());
    EXPECT_TRUE(trace.searches.empty());
    EXPECT_TRUE(trace.candidates.empty());
}

}  // namespace
}  // namespace graspd
