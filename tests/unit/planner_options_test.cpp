// What a request may ask of plan(): sources, counts, directions, surroundings, clearance, friction,
// mass. All lengths in the comments in mm.

#include "graspd/planner/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::out_of;
using test::planned;
using test::rejections_of;
using test::request_for;

/// A request that asks for one source alone.
PlanRequest from_source(TriangleMesh mesh, GraspSource source) {
    PlanRequest request = request_for(std::move(mesh));
    request.options.sources = source;
    return request;
}

TEST(Plan, KeepsToTheSourcesThatAreAskedFor) {
    const TriangleMesh mesh = test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 2000);
    for (const GraspSource source : {kBoundary, kWall, kWholeObject}) {
        const PlanReply reply = planned(from_source(mesh, source));
        ASSERT_EQ(reply.status, PlanStatus::kOk) << to_string(source) << reply.message;
        for (const Grasp& grasp : reply.grasps) EXPECT_EQ(grasp.source, source);
    }
    // 0 means all, as 7 does.
    PlanRequest request = request_for(mesh);
    const PlanReply all = planned(request);
    request.options.sources = 0;
    test::expect_identical(planned(request), all);
    // A convex object has no concavity to close along or across.
    EXPECT_EQ(planned(from_source(test::box({0.06, 0.04, 0.08}), kBoundary)).status,
              PlanStatus::kNoGrasp);
}

// The method is the config's, and its error is the reply's: no other method stands in for it.
TEST(Plan, UsesTheConcavityMethodOfTheConfig) {
    const PlanRequest request =
        request_for(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000));
    PlannerConfig config;
    config.vertex_concavity.method = "tetrahedral";
    config.tetrahedral_concavity.cell_size = 0.05;
    const PlanReply reply = planned(request, config);
    EXPECT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    EXPECT_NE(test::stage_of(reply, "concavity/tetrahedral_concavity"), nullptr);
    EXPECT_EQ(test::stage_of(reply, "concavity/shortest_path_concavity"), nullptr);
    config.tetrahedral_concavity.max_cells = 10;
    const PlanReply refused = plan(request, config);
    EXPECT_EQ(refused.status, PlanStatus::kInvalidRequest);
    EXPECT_NE(refused.message.find("max_cells = 10 is passed"), std::string::npos)
        << refused.message;
}

TEST(Plan, ReturnsNoMoreThanAreAskedFor) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    for (const std::uint32_t most : {1U, 2U, 7U, 1000U}) {
        request.options.max_grasps = most;
        const PlanReply reply = planned(request);
        ASSERT_EQ(reply.status, PlanStatus::kOk);
        EXPECT_EQ(reply.grasps.size() == most, most < 1000U);
    }
}

constexpr const char* kGraded = "grasp/contact_patch";

// A hand gets to a ball from all sides, and nearly every pose that it gets to holds. Of each of
// the 24 axes eight poses are tried, of which six hold and more; with a least clearance all, as the
// one that is clear may be the last.
TEST(Plan, LeavesAnAxisWhenEnoughOfItsPosesHold) {
    constexpr const char* kPoses = "planner/find_poses";
    PlanRequest request = from_source(test::sphere(0.03, 2000), kWholeObject);
    PlannerConfig config;
    config.search.good_axes_per_round = 24;
    const PlanReply few = planned(request, config);
    EXPECT_EQ(out_of(few, kGraded), 24U * 8U);
    EXPECT_EQ(rejections_of(few, "pose_surplus"), out_of(few, kPoses) - 24 * 8);
    config.search.grasps_per_axis = 9;
    EXPECT_GT(out_of(planned(request, config), kGraded), 24U * 9U);
    request.options.min_clearance_m = 1e-4;
    const PlanReply all = planned(request);
    EXPECT_EQ(rejections_of(all, "pose_surplus"), 0U);
    EXPECT_GT(out_of(all, kGraded), 24U * 16U);
}

// A ball's grasps are all good. A round ends after ten axes, each with its eight poses, or after as
// many as grasps are asked for; where good ones are wanted that do not exist, after all 24.
TEST(Plan, LeavesARoundWhenEnoughOfItsAxesAreGood) {
    PlanRequest request = from_source(test::sphere(0.03, 2000), kWholeObject);
    EXPECT_EQ(out_of(planned(request), kGraded), 10U * 8U);
    request.options.max_grasps = 15;
    EXPECT_EQ(out_of(planned(request), kGraded), 15U * 8U);
    request.options.max_grasps = 1;
    PlannerConfig config;
    config.search.good_axes_per_round = 3;
    EXPECT_EQ(out_of(planned(request, config), kGraded), 3U * 8U);
    request.options.friction = 0.2;  // no score is so high
    config.search.good_score = 1.0;
    const PlanReply poor = planned(request, config);
    ASSERT_FALSE(poor.grasps.empty());
    EXPECT_LT(poor.grasps.front().score, 1.0);
    EXPECT_EQ(out_of(poor, kGraded), 24U * 8U);
}

TEST(Plan, ComesWithinTheApproachCones) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    const Vector3d down = -Vector3d::UnitZ();
    request.approach_cones = {{down, 0.3}};
    const PlanReply from_above = planned(request);
    ASSERT_EQ(from_above.status, PlanStatus::kOk) << from_above.message;
    for (const Grasp& grasp : from_above.grasps) {
        EXPECT_GE(grasp.X_FG.linear().col(2).dot(down), std::cos(0.3) - 1e-9);
    }
    EXPECT_GT(rejections_of(from_above, "outside_approach_cones"), 0U);
    // A second cone lets more in, and each grasp keeps to one of the two.
    const Vector3d sideways = Vector3d::UnitX();
    request.approach_cones.push_back({sideways, 0.3});
    const PlanReply both = planned(request);
    ASSERT_EQ(both.status, PlanStatus::kOk);
    for (const Grasp& grasp : both.grasps) {
        const Vector3d z = grasp.X_FG.linear().col(2);
        EXPECT_GE(std::max(z.dot(down), z.dot(sideways)), std::cos(0.3) - 1e-9);
    }
    // Cones are in F: with the object turned on its side they still mean the world's down.
    request.approach_cones = {{down, 0.3}};
    request.X_FO.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    for (const Grasp& grasp : planned(request).grasps) {
        EXPECT_GE(grasp.X_FG.linear().col(2).dot(down), std::cos(0.3) - 1e-9);
    }
}

/// Corners of the hand's three boxes in F, open, at the grasp and at the pre-grasp: parallel_85.
std::vector<Vector3d> hand_corners(const Grasp& grasp) {
    const double inner = 0.5 * grasp.open_width_m, outer = inner + 0.01;
    const std::vector<std::pair<Vector3d, Vector3d>> boxes = {
        {{-0.06, -0.02, -0.115}, {0.06, 0.02, -0.035}},
        {{-outer, -0.01, -0.035}, {-inner, 0.01, 0.01}},
        {{inner, -0.01, -0.035}, {outer, 0.01, 0.01}}};
    std::vector<Vector3d> corners;
    for (const auto& [low, high] : boxes) {
        for (unsigned k = 0; k < 8; ++k) {
            const Vector3d corner((k & 1u) != 0 ? high.x() : low.x(),
                                  (k & 2u) != 0 ? high.y() : low.y(),
                                  (k & 4u) != 0 ? high.z() : low.z());
            corners.push_back(grasp.X_FG * corner);
            corners.push_back(grasp.X_FG_pregrasp * corner);
        }
    }
    return corners;
}

// A block lies on a table; no corner of the hand comes below it, and the hand retreats upwards.
TEST(Plan, StaysAboveTheSupportPlane) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.03}, 500));
    const PlanReply floating = planned(request);
    const auto below = [](const Grasp& grasp) {
        return std::ranges::any_of(hand_corners(grasp),
                                   [](const Vector3d& p) { return p.z() < -0.015; });
    };
    EXPECT_TRUE(std::ranges::any_of(floating.grasps, below));  // else the plane tests nothing
    request.support_plane = SupportPlane{Vector3d::UnitZ(), -0.015};
    const PlanReply lying = planned(request);
    ASSERT_EQ(lying.status, PlanStatus::kOk) << lying.message;
    for (const Grasp& grasp : lying.grasps) {
        EXPECT_FALSE(below(grasp));
        EXPECT_LT((grasp.retreat.direction_F - Vector3d::UnitZ()).norm(), 1e-12);
    }
    // A normal as long as a request may bring it is taken for its direction alone.
    request.support_plane->normal_F *= 1.0009;
    const PlanReply longer = planned(request);
    ASSERT_EQ(longer.grasps.size(), lying.grasps.size());
    for (std::size_t i = 0; i < lying.grasps.size(); ++i) {
        EXPECT_EQ(longer.grasps[i].retreat.direction_F, Vector3d::UnitZ());
        EXPECT_EQ(longer.grasps[i].score, lying.grasps[i].score);
    }
    // The same in a frame that is turned and shifted as a whole.
    const Eigen::Isometry3d X = test::random_pose(8);
    request.X_FO = X;
    request.support_plane->normal_F = X.linear().col(2);
    request.support_plane->offset_m = -0.015 + X.linear().col(2).dot(X.translation());
    const PlanReply moved = planned(request);
    ASSERT_EQ(moved.status, PlanStatus::kOk);
    EXPECT_NEAR(moved.grasps.front().score, lying.grasps.front().score, 1e-6);
}

// No hand enters a keep-out box: around the best grasp's palm, none of the hand's corners, nor its
// middle, is inside, and that grasp is gone.
TEST(Plan, KeepsOutOfBoxesAndObstacles) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    const Grasp best = planned(request).grasps.front();
    OrientedBox box;
    box.pose.translation() = best.X_FG * Vector3d(0, 0, -0.075);
    box.half_extent = Vector3d(0.03, 0.03, 0.03);
    const auto enters = [&](const Grasp& grasp) {
        // The palm's middle line and the hand's corners; the box is wider than the palm is thick.
        auto points = hand_corners(grasp);
        for (double z = -0.215; z <= -0.035; z += 0.01) {
            points.emplace_back(grasp.X_FG * Vector3d(0, 0, z));
        }
        return std::ranges::any_of(points, [&](const Vector3d& p) {
            return ((box.pose.inverse() * p).cwiseAbs() - box.half_extent).maxCoeff() < 0.0;
        });
    };
    ASSERT_TRUE(enters(best));
    request.keep_out_F = {box};
    const PlanReply kept_out = planned(request);
    ASSERT_EQ(kept_out.status, PlanStatus::kOk) << kept_out.message;
    for (const Grasp& grasp : kept_out.grasps) EXPECT_FALSE(enters(grasp));

    request.keep_out_F.clear();
    request.obstacles = {{test::box(2.0 * box.half_extent), box.pose}};
    const PlanReply avoided = planned(request);
    ASSERT_EQ(avoided.status, PlanStatus::kOk) << avoided.message;
    for (const Grasp& grasp : avoided.grasps) EXPECT_FALSE(enters(grasp));
    EXPECT_NEAR(avoided.grasps.front().score, kept_out.grasps.front().score, 1e-6);

    // Shut in on all sides there is no way to it, and the reply says what stands there.
    request.obstacles = {{test::box({0.5, 0.5, 0.5}), Eigen::Isometry3d::Identity()}};
    const PlanReply shut_in = planned(request);
    EXPECT_EQ(shut_in.status, PlanStatus::kNoGrasp);
    EXPECT_NE(shut_in.message.find("obstacle"), std::string::npos) << shut_in.message;
}

TEST(Plan, HonoursTheLeastClearance) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    request.options.max_grasps = 50;
    std::size_t before = planned(request).grasps.size();
    for (const double least_m : {0.004, 0.007, 0.009}) {
        request.options.min_clearance_m = least_m;
        const PlanReply reply = planned(request);
        ASSERT_EQ(reply.status, PlanStatus::kOk) << least_m;
        for (const Grasp& grasp : reply.grasps) EXPECT_GE(grasp.clearance_m, least_m);
        EXPECT_LE(reply.grasps.size(), before);
        before = reply.grasps.size();
    }
    // Whoever wants one grasp gets one where whoever wants fifty gets some.
    request.options.max_grasps = 1;
    EXPECT_EQ(planned(request).status, PlanStatus::kOk);
    // The pads approach with a margin of 10 at most: more is impossible.
    request.options.min_clearance_m = 0.0101;
    const PlanReply none = planned(request);
    EXPECT_EQ(none.status, PlanStatus::kNoGrasp);
    EXPECT_GT(rejections_of(none, "clearance"), 0U);
    ASSERT_FALSE(none.report.near_misses.empty());
    EXPECT_EQ(none.report.near_misses.front().reason, "clearance");
    EXPECT_NEAR(none.report.near_misses.front().margin, 0.0001, 1e-6);
}

// Sides that lean by 20 degrees need a friction of tan 20 = 0.364. The wedge is 110 long and 100
// high, so that a hand can close on those sides alone.
TEST(Plan, SlipsBelowTheFrictionItNeeds) {
    const double tangent = std::tan(20.0 * std::numbers::pi / 180.0);
    PlanRequest request =
        request_for(test::wedge(0.05, 0.05 + 2.0 * 0.10 * tangent, 0.11, 0.10, 2000));
    request.options.friction = 0.37;
    const PlanReply held = planned(request);
    ASSERT_EQ(held.status, PlanStatus::kOk) << held.message;
    EXPECT_NEAR(held.grasps.front().min_friction, tangent, 1e-3);
    request.options.friction = 0.34;
    const PlanReply slipped = planned(request);
    EXPECT_EQ(slipped.status, PlanStatus::kNoGrasp);
    EXPECT_GT(rejections_of(slipped, "slips"), 0U);
    for (const NearMiss& miss : slipped.report.near_misses) {
        if (miss.reason != "slips") continue;
        EXPECT_NEAR(miss.margin, tangent - 0.34, 1e-3);
        EXPECT_EQ(miss.unit, "1");
    }
}

// Two grippers: the one that is too small gets none, the other one's grasps name it.
TEST(Plan, TheBestGripperWins) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    request.grippers.push_back(request.grippers.front());
    request.grippers.front().name = "small";
    request.grippers.front().max_width_m = 0.03;
    const PlanReply reply = plan(request, {});
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    for (const Grasp& grasp : reply.grasps) EXPECT_EQ(grasp.gripper_name, "parallel_85");
}

// Volume 0.06 x 0.04 x 0.08 x 500 kg/m3 = 0.096 kg; a given mass counts instead.
TEST(Plan, TheForceCarriesTheMass) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    EXPECT_NEAR(planned(request).grasps.front().min_force_N, 0.096 * 9.81 / 1.2, 1e-6);
    request.options.mass_kg = 0.4;
    EXPECT_NEAR(planned(request).grasps.front().min_force_N, 0.4 * 9.81 / 1.2, 1e-6);
    request.options.mass_kg.reset();  // a ball of 113 cm3 weighs 0.057, one of 4.2 cm3 the least
    request.object_O = test::sphere(0.01, 4000);
    const Grasp ball = planned(request).grasps.front();
    EXPECT_NEAR(ball.min_force_N, 0.02 * 9.81 / (2.0 * (0.6 - ball.min_friction)), 1e-6);
}

// A lever costs score: a centre of mass at one end draws the best grasp there.
TEST(Plan, TheCentreOfMassDrawsTheGrasp) {
    PlanRequest request = request_for(test::box({0.04, 0.04, 0.2}, 2000));
    EXPECT_LT(std::abs(planned(request).grasps.front().X_FG.translation().z()), 0.02);
    request.options.center_of_mass_O = Vector3d(0, 0, 0.08);
    request.options.mass_kg = 0.5;
    EXPECT_GT(planned(request).grasps.front().X_FG.translation().z(), 0.05);
}

}  // namespace
}  // namespace graspd
