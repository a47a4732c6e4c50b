// plan() from end to end, on objects whose best grasps can be said by hand. All lengths in the
// comments in mm.

#include "graspd/planner/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::planned;
using test::rejections_of;
using test::request_for;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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

// Small moves make no grasp worse and that of the heavy block, or of the cup, better.
// Clearance is weighed after the moves, so it is left out here.
TEST(Plan, RefinementRaisesTheScore) {
    PlannerConfig plain;
    plain.score_grasp.clearance_weight = 0.0;
    plain.search.refined = 0;
    PlannerConfig refined = plain;
    refined.search.refined = 5;
    int better = 0;
    for (const TriangleMesh& mesh :
         {test::cup(0.045, 0.09, 0.004, 4000), test::box({0.05, 0.12, 0.2}, 2000),
          test::box({0.06, 0.04, 0.08})}) {
        const PlanReply before = plan(request_for(mesh), plain);
        const PlanReply after = plan(request_for(mesh), refined);
        ASSERT_EQ(before.status, PlanStatus::kOk);
        ASSERT_EQ(after.status, PlanStatus::kOk);
        EXPECT_GE(after.grasps.front().score, before.grasps.front().score);
        better += after.grasps.front().score > before.grasps.front().score ? 1 : 0;
    }
    EXPECT_GE(better, 1);
}

/// An object that cannot be planned for and what the message must name.
struct Flaw {
    const char* name;
    std::variant<TriangleMesh, PointCloud> object;
    std::vector<std::string> words;
};
std::vector<Flaw> flawed_objects() {
    const TriangleMesh block = test::box({0.06, 0.04, 0.08});
    TriangleMesh not_finite = block, out_of_range = block, line = block;
    not_finite.vertices[3].y() = kNaN;
    out_of_range.faces[5][1] = 4711;
    for (Vector3d& vertex : line.vertices) vertex.head<2>().setZero();
    PointCloud nothing_finite;
    nothing_finite.points.assign(100, Vector3d::Constant(kNaN));
    return {{"empty mesh", TriangleMesh{}, {"empty"}},
            {"vertices without faces", TriangleMesh{block.vertices, {}}, {"empty"}},
            {"not finite", not_finite, {"3", "nan"}},
            {"index out of range", out_of_range, {"5", "4711"}},
            {"line", line, {"degenerate"}},
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

// A sheet has no inside of its own: it is wrapped, and whoever reads the reply is told.
TEST(Plan, AFlatSheetIsWrapped) {
    TriangleMesh sheet = test::box({0.06, 0.04, 0.08});
    for (Vector3d& vertex : sheet.vertices) vertex.z() = 0.0;
    PlanRequest request = request_for({});
    request.object_O = sheet;
    const PlanReply reply = plan(request, {});
    EXPECT_NE(reply.status, PlanStatus::kInvalidRequest) << reply.message;
    EXPECT_NE(reply.status, PlanStatus::kInternalError) << reply.message;
    EXPECT_TRUE(std::ranges::any_of(
        reply.report.findings, [](const Finding& each) { return each.code == "alpha_wrapped"; }));
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
