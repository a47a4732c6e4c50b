// plan() from end to end, on objects whose best grasps can be said by hand. All lengths in the
// comments in mm.

#include "graspd/planner/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::expect_consistent;
using test::expect_counts_add_up;
using test::rejections_of;
using test::request_for;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PlanReply planned(const PlanRequest& request, const PlannerConfig& config = {}) {
    PlanReply reply = plan(request, config);
    expect_consistent(reply, request, config);
    if (reply.status == PlanStatus::kOk || reply.status == PlanStatus::kNoGrasp) {
        expect_counts_add_up(reply, config);
    }
    return reply;
}

/// A request that asks for one source alone.
PlanRequest from_source(TriangleMesh mesh, GraspSource source) {
    PlanRequest request = request_for(std::move(mesh));
    request.options.sources = source;
    return request;
}

// Plates of 60 x 48 x 10 on a square neck, 20 wide and 30 long. The boundary of the neck's region
// runs down the neck's two sides; a hand can also close over the plates' edges, 48 or 60 apart, but
// not along z from within. Somewhere among the best are grasps across the neck, its contacts on the
// two sides.
TEST(Plan, ClosesAcrossTheNeckOfAnHourglass) {
    const PlanRequest request =
        from_source(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 2000), kBoundary);
    const PlanReply reply = planned(request);
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    EXPECT_EQ(reply.strategy, "concavity");
    const Grasp& best = reply.grasps.front();
    EXPECT_NEAR(best.width_m, 0.02, 0.0005);
    EXPECT_EQ(best.concavity_index, 0);
    EXPECT_NEAR(best.concavity_depth_m, 0.02, 1e-6);
    const Vector3d& left = best.contacts[0].point_F;
    const Vector3d& right = best.contacts[1].point_F;
    const Eigen::Index across = std::abs(left.x()) > 0.0099 ? 0 : 1;
    EXPECT_NEAR(std::abs(left[across]), 0.01, 1e-6);
    EXPECT_NEAR(left[across], -right[across], 1e-6);
    for (const Vector3d& point : {left, right}) EXPECT_LE(std::abs(point.z()), 0.015);
}

struct Convex {
    const char* name;
    TriangleMesh mesh;
};
std::vector<Convex> convex_shapes() {
    return {{"box", test::box({0.06, 0.04, 0.08}, 500)},
            {"cylinder", test::cylinder(0.03, 0.1, 4000)},
            {"sphere", test::sphere(0.03, 4000)},
            {"thin plate", test::box({0.12, 0.10, 0.008}, 2000)}};
}

TEST(Plan, OfAConvexObjectTheWholeIsTheRegion) {
    for (const auto& [name, mesh] : convex_shapes()) {
        SCOPED_TRACE(name);
        const PlanReply reply = planned(request_for(mesh));
        ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
        EXPECT_EQ(reply.strategy, "whole_object");
        for (const Grasp& grasp : reply.grasps) {
            EXPECT_EQ(grasp.source, kWholeObject);
            // The contacts lie on opposite sides: their normals point away from each other.
            EXPECT_LT(grasp.contacts[0].normal_F.dot(grasp.contacts[1].normal_F), -0.9);
        }
    }
}

// Of a block the width is one of its three sides, and both contacts lie in those faces.
TEST(Plan, ABlockIsAsWideAsItsSides) {
    const Vector3d size(0.06, 0.04, 0.08);
    const PlanReply reply = planned(request_for(test::box(size, 500)));
    ASSERT_EQ(reply.status, PlanStatus::kOk);
    for (const Grasp& grasp : reply.grasps) {
        Eigen::Index axis = 0;
        EXPECT_NEAR(grasp.X_FG.linear().col(0).cwiseAbs().maxCoeff(&axis), 1.0, 1e-6);
        EXPECT_NEAR(grasp.width_m, size[axis], 1e-6);
        EXPECT_NEAR(std::abs(grasp.contacts[0].point_F[axis]), 0.5 * size[axis], 1e-6);
        EXPECT_NEAR(grasp.contacts[0].point_F[axis], -grasp.contacts[1].point_F[axis], 1e-6);
        EXPECT_NEAR(grasp.min_friction, 0.0, 1e-6);
        EXPECT_NEAR(grasp.beta_rad, 0.0, 1e-6);
        EXPECT_NEAR(grasp.clearance_m, 0.5 * (grasp.open_width_m - grasp.width_m), 0.01 + 1e-9);
    }
}

// A cylinder of radius 30 is gripped across its axis (its length of 100 is too much), a sphere
// anywhere. The line stands off the middle by d at most 5: chord 2 sqrt(900 - d^2) from 59.1 on,
// less the sagitta of 4000 faces, 0.1 at most.
TEST(Plan, RoundObjectsAreAsWideAsTheirDiameter) {
    for (const TriangleMesh& mesh : {test::cylinder(0.03, 0.1, 4000), test::sphere(0.03, 4000)}) {
        const PlanReply reply = planned(request_for(mesh));
        ASSERT_EQ(reply.status, PlanStatus::kOk);
        for (const Grasp& grasp : reply.grasps) {
            EXPECT_LE(grasp.width_m, 0.06 + 1e-9);
            EXPECT_GE(grasp.width_m, 0.059);
        }
    }
}

// Nothing of a block of 100 x 120 x 140 fits between fingers that open by 85: 15 are lacking, and
// that is what the reply must say.
TEST(Plan, WhatIsTooWideIsSaidToBe) {
    const PlanReply reply = planned(request_for(test::box({0.10, 0.12, 0.14}, 500)));
    EXPECT_EQ(reply.status, PlanStatus::kNoGrasp);
    EXPECT_GT(rejections_of(reply, "axis_too_wide") + rejections_of(reply, "too_wide"), 0U);
    EXPECT_NE(reply.message.find("too_wide"), std::string::npos) << reply.message;
}

// A cup's wall, 4 thick and 80 across, is gripped from above with one finger inside.
TEST(Plan, ACupIsGrippedByItsRim) {
    const PlanReply reply = planned(request_for(test::cup(0.045, 0.09, 0.004, 4000)));
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    const Grasp& best = reply.grasps.front();
    EXPECT_LT(best.width_m, 0.007);
    EXPECT_LT(best.X_FG.linear()(2, 2), -0.7);  // from above
}

/// An object that cannot be planned for and what the message must name.
struct Flaw {
    const char* name;
    std::variant<TriangleMesh, PointCloud> object;
    std::vector<std::string> words;
};
std::vector<Flaw> flawed_objects() {
    const TriangleMesh block = test::box({0.06, 0.04, 0.08});
    TriangleMesh not_finite = block, out_of_range = block, flat = block;
    not_finite.vertices[3].y() = kNaN;
    out_of_range.faces[5][1] = 4711;
    for (Vector3d& vertex : flat.vertices) vertex.z() = 0.0;
    PointCloud nothing_finite;
    nothing_finite.points.assign(100, Vector3d::Constant(kNaN));
    return {{"empty mesh", TriangleMesh{}, {"empty"}},
            {"vertices without faces", TriangleMesh{block.vertices, {}}, {"empty"}},
            {"not finite", not_finite, {"3", "nan"}},
            {"index out of range", out_of_range, {"5", "4711"}},
            {"flat sheet", flat, {}},
            {"empty cloud", PointCloud{}, {}},
            {"cloud of NaN", nothing_finite, {}}};
}

TEST(Plan, AFlawedObjectIsNamed) {
    for (const Flaw& flaw : flawed_objects()) {
        PlanRequest request = request_for({});
        request.object_O = flaw.object;
        const PlanReply reply = plan(request, {});
        EXPECT_EQ(reply.status, PlanStatus::kInvalidRequest) << flaw.name << ": " << reply.message;
        EXPECT_TRUE(reply.grasps.empty());
        EXPECT_FALSE(reply.message.empty()) << flaw.name;
        EXPECT_EQ(reply.request_id, request.request_id);
        EXPECT_EQ(reply.frame_id, request.frame_id);
        for (const std::string& word : flaw.words) {
            EXPECT_NE(reply.message.find(word), std::string::npos)
                << flaw.name << ": " << reply.message;
        }
    }
}

// Any other field goes through check_request, whose table has a test of its own, and the settings
// through validate().
TEST(Plan, AFlawedRequestOrSettingIsNamed) {
    const auto expect = [](const std::function<void(PlanRequest&, PlannerConfig&)>& spoil,
                           const char* field) {
        PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}));
        PlannerConfig config;
        spoil(request, config);
        const PlanReply reply = plan(request, config);
        EXPECT_EQ(reply.status, PlanStatus::kInvalidRequest) << field;
        EXPECT_NE(reply.message.find(field), std::string::npos) << reply.message;
        EXPECT_TRUE(reply.grasps.empty());
    };
    expect([](auto& r, auto&) { r.grippers.clear(); }, "grippers");
    expect([](auto& r, auto&) { r.grippers.front().max_width_m = 0.0; }, "gripper.max_width");
    expect([](auto& r, auto&) { r.options.friction = 0.0; }, "options.friction");
    expect([](auto& r, auto&) { r.X_FO.linear() *= 2.0; }, "object_pose");
    expect([](auto&, auto& c) { c.search.levels = 0; }, "search.levels");
    expect([](auto&, auto& c) { c.local_cloud.max_depth_m = kNaN; }, "local_cloud.max_depth_m");
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

TEST(Plan, ReturnsNoMoreThanAreAskedFor) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    for (const std::uint32_t most : {1U, 2U, 7U, 1000U}) {
        request.options.max_grasps = most;
        const PlanReply reply = planned(request);
        ASSERT_EQ(reply.status, PlanStatus::kOk);
        EXPECT_EQ(reply.grasps.size() == most, most < 1000U);
    }
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

TEST(ObjectKey, TellsGeometriesApart) {
    const TriangleMesh block = test::box({0.06, 0.04, 0.08});
    TriangleMesh other = block;
    EXPECT_EQ(object_key_of(block), object_key_of(other));
    other.vertices[0].x() = std::nextafter(other.vertices[0].x(), 1.0);
    EXPECT_NE(object_key_of(block), object_key_of(other));
    TriangleMesh turned = block;
    std::swap(turned.faces[0][0], turned.faces[0][1]);
    EXPECT_NE(object_key_of(block), object_key_of(turned));
    EXPECT_NE(object_key_of(block), object_key_of(PointCloud{block.vertices, {}}));
    EXPECT_EQ(planned(request_for(block)).object_key, object_key_of(block));
}

}  // namespace
}  // namespace graspd
