// An object prepared once serves every later plan, and nobody can tell but by the time.

#include "graspd/planner/prepared_object.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "graspd/planner/planner.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using test::request_for;

/// Two hands, a table, something in the way: what a prepared object must not depend on.
std::vector<PlanRequest> scenes_about(const std::variant<TriangleMesh, PointCloud>& object) {
    PlanRequest plain = request_for(test::box({0.01, 0.01, 0.01}, 12));
    plain.object_O = object;
    PlanRequest narrow = plain;
    narrow.grippers[0].name = "narrow";
    narrow.grippers[0].finger_width_m *= 0.7;
    narrow.options.friction = 0.4;
    PlanRequest on_table = plain;
    on_table.X_FO.translation() = Eigen::Vector3d(0.3, -0.1, 0.05);
    on_table.support_plane = {Eigen::Vector3d::UnitZ(), 0.0};
    on_table.obstacles.push_back({test::box({0.02, 0.02, 0.1}, 12), Eigen::Isometry3d::Identity()});
    on_table.obstacles[0].X_FO.translation() = Eigen::Vector3d(0.38, -0.1, 0.05);
    PlanRequest none = plain;
    none.options.min_clearance_m = 0.9;
    return {plain, narrow, on_table, none};
}

/// An object that needs repair, so that it has findings.
TriangleMesh open_hourglass() {
    TriangleMesh mesh = test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000);
    mesh.faces.erase(mesh.faces.begin() + 7);
    mesh.faces.push_back(mesh.faces.front());
    return mesh;
}

PointCloud corners_of(const TriangleMesh& mesh) {
    return {mesh.vertices, std::nullopt};
}

TEST(PreparedObject, AWarmPlanGivesWhatAColdOneGives) {
    for (const std::variant<TriangleMesh, PointCloud>& object :
         {std::variant<TriangleMesh, PointCloud>(open_hourglass()),
          std::variant<TriangleMesh, PointCloud>(corners_of(test::lopsided(1000)))}) {
        SCOPED_TRACE(object.index() == 0 ? "mesh" : "cloud");
        PreparedObjectPtr kept;
        for (const PlanRequest& request : scenes_about(object)) {
            const PlanReply cold = plan(request, {});
            EXPECT_FALSE(cold.report.findings.empty());
            PlanRequest named = request;  // what plan() must not look at any more
            if (kept) named.object_O = TriangleMesh{};
            const PreparedObjectPtr before = kept;
            const PlanReply warm = plan(named, kept, {});
            test::expect_identical(cold, warm);
            ASSERT_NE(kept, nullptr);
            if (before) {
                EXPECT_EQ(kept, before);
            }
        }
    }
}

// The stages that were done before stand in their place with their counts, at 0 ms.
TEST(PreparedObject, StagesDoneBeforeTakeNoTime) {
    const PlanRequest request = request_for(test::lopsided(1000));
    PreparedObjectPtr kept;
    const auto cold = plan(request, kept, {}).report.stages;
    const auto warm = plan(request, kept, {}).report.stages;
    ASSERT_EQ(cold.size(), warm.size());
    const auto prepared = std::ranges::find(warm, "mesh/sample_surface", &StageReport::name);
    ASSERT_NE(prepared, warm.end());
    for (auto stage = warm.begin(); stage != prepared; ++stage) EXPECT_EQ(stage->ms, 0.0);
    EXPECT_GE(prepared - warm.begin(), 5);
    EXPECT_GT(prepared->ms, 0.0);
    EXPECT_GT(cold.front().ms, 0.0);
}

TEST(PreparedObject, PrepareGivesWhatAPlanLeaves) {
    const PlanRequest request = request_for(open_hourglass());
    auto prepared = prepare(request.object_O, {});
    ASSERT_TRUE(prepared.ok());
    PreparedObjectPtr object = prepared.value();
    test::expect_identical(plan(request, {}), plan(request, object, {}));
    EXPECT_EQ(object, prepared.value());
    EXPECT_EQ(prepare(TriangleMesh{}, {}).error().code, PlanErrorCode::kInvalidInput);
    PlannerConfig bad;
    bad.search.levels = 0;
    EXPECT_EQ(prepare(request.object_O, bad).error().code, PlanErrorCode::kInvalidInput);
}

TEST(PreparedObject, WhatCannotBePreparedLeavesNothing) {
    PreparedObjectPtr object;
    PlanRequest request = request_for(TriangleMesh{});
    test::expect_identical(plan(request, {}), plan(request, object, {}));
    EXPECT_EQ(object, nullptr);
    request = request_for(test::lopsided(300));
    request.options.friction = -1.0;  // refused before the object is looked at
    EXPECT_EQ(plan(request, object, {}).status, PlanStatus::kInvalidRequest);
    EXPECT_EQ(object, nullptr);
}

// Search settings may differ from one plan to the next; those of the preparation may not.
TEST(PreparedObject, OtherSettingsOfThePreparationAreRefused) {
    const PlanRequest request = request_for(test::lopsided(300));
    PreparedObjectPtr object = prepare(request.object_O, {}).value();
    PlannerConfig config;
    config.rank_grasps = {};
    config.search.levels = 2;
    test::expect_identical(plan(request, config), plan(request, object, config));
    const auto refused = [&](auto&& change) {
        PlannerConfig other;
        change(other);
        const PlanReply reply = plan(request, object, other);
        return reply.status == PlanStatus::kInvalidRequest &&
               reply.message.find(object_key_of(request.object_O)) != std::string::npos;
    };
    EXPECT_TRUE(refused([](PlannerConfig& c) { c.search.exact_concavity = true; }));
    EXPECT_TRUE(refused([](PlannerConfig& c) { c.condition_mesh.alpha_wrap = false; }));
    EXPECT_TRUE(refused([](PlannerConfig& c) { c.vertex_concavity.method = "tetrahedral"; }));
    EXPECT_TRUE(refused([](PlannerConfig& c) { c.shortest_path_concavity.start_offset *= 2; }));
    EXPECT_TRUE(refused([](PlannerConfig& c) { c.triangulate_cloud.max_points = 11; }));
    EXPECT_TRUE(refused([](PlannerConfig& c) { c.face_sensor.back_thickness *= 2; }));
}

TEST(ObjectKey, IsOfEverythingThatMakesAnObject) {
    const TriangleMesh mesh = test::lopsided(300);
    PointCloud cloud = corners_of(mesh);
    const std::string of_mesh = object_key_of(mesh);
    const std::string of_cloud = object_key_of(cloud);
    EXPECT_EQ(of_mesh.size(), 32u);
    EXPECT_EQ(of_mesh, object_key_of(TriangleMesh(mesh)));
    EXPECT_NE(of_mesh, of_cloud);
    cloud.sensor_origin = Eigen::Vector3d::Zero();
    EXPECT_NE(of_cloud, object_key_of(cloud));
    TriangleMesh turned = mesh;
    std::ranges::rotate(turned.faces[5], turned.faces[5].begin() + 1);
    EXPECT_NE(of_mesh, object_key_of(turned));
}

}  // namespace
}  // namespace graspd
