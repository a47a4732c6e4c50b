#include <gmock/gmock.h>

#include "plan_scene.hpp"
#include "support/shapes.hpp"

namespace graspd::cli {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// A table at z = 0 with two blocks on it, 4 x 5 x 8 cm at x = 0.1 and 6 x 7 x 9 cm at x = -0.1.
PlanRequest scene() {
    PointCloud cloud;
    for (int i = -60; i <= 60; ++i) {
        for (int j = -40; j <= 40; ++j) cloud.points.emplace_back(0.005 * i, 0.005 * j, 0.0);
    }
    const auto add = [&](const Vector3d& size, double x) {
        for (const Vector3d& point : test::box(size, 3000).vertices) {
            const Vector3d place = point + Vector3d(x, 0.0, 0.5 * size.z());
            if (place.z() > 0.001) cloud.points.push_back(place);
        }
    };
    add({0.04, 0.05, 0.08}, 0.1);
    add({0.06, 0.07, 0.09}, -0.1);
    PlanRequest request;
    request.request_id = "scene";
    request.object_O = std::move(cloud);
    Gripper gripper;
    gripper.name = "hand";
    request.grippers = {gripper};
    return request;
}

void expect_from_above(const ScenePlan& plan) {
    ASSERT_EQ(plan.reply.status, PlanStatus::kOk) << plan.reply.message;
    ASSERT_TRUE(plan.request.support_plane.has_value());
    EXPECT_GT(plan.request.support_plane->normal_F.z(), 0.999);
    EXPECT_NEAR(plan.request.support_plane->offset_m, 0.0, 1e-3);
    EXPECT_EQ(plan.request.obstacles.size(), 1u);
    ASSERT_FALSE(plan.reply.report.findings.empty());
    EXPECT_EQ(plan.reply.report.findings[0].code, "scene_objects");
    EXPECT_EQ(plan.reply.report.findings[0].value, 2.0);
}

TEST(PlanScene, PlansForTheObjectNearAPlace) {
    for (const double x : {0.1, -0.1}) {
        const auto plan = plan_scene(scene(), Vector3d(x, 0.02, 0.0), {}, {});
        ASSERT_TRUE(plan.ok()) << plan.error().detail;
        expect_from_above(plan.value());
        for (const Grasp& grasp : plan.value().reply.grasps) {
            EXPECT_NEAR(grasp.X_FG.translation().x(), x, 0.05);
            EXPECT_GT(grasp.X_FG.translation().z(), 0.0);
        }
    }
}

// Of both plans the one with the better grasp is the reply; it says so.
TEST(PlanScene, ElseForTheOneWithTheBestGrasp) {
    const auto best = plan_scene(scene(), std::nullopt, {}, {});
    ASSERT_TRUE(best.ok()) << best.error().detail;
    expect_from_above(best.value());
    for (const double x : {0.1, -0.1}) {
        const auto each = plan_scene(scene(), Vector3d(x, 0.0, 0.0), {}, {});
        ASSERT_TRUE(each.ok());
        EXPECT_GE(best.value().reply.grasps[0].score, each.value().reply.grasps[0].score);
    }
    EXPECT_THAT(best.value().reply.report.findings[0].detail,
                HasSubstr("this reply is for object"));
}

TEST(PlanScene, TheGapBetweenObjectsIsASetting) {
    PlannerConfig config;
    config.segment_scene.gap_m = 0.4;  // farther than the objects stand apart
    const auto plan = plan_scene(scene(), Vector3d(0.0, 0.0, 0.0), config, {});
    ASSERT_TRUE(plan.ok()) << plan.error().detail;
    EXPECT_EQ(plan.value().reply.report.findings[0].value, 1.0);  // scene_objects
}

TEST(PlanScene, NeedsACloudWithAPlane) {
    PlanRequest request = scene();
    request.object_O = test::box({0.1, 0.1, 0.1});
    EXPECT_THAT(plan_scene(request, {}, {}, {}).error().detail, HasSubstr("--scene needs a cloud"));
    request.object_O = PointCloud{test::sphere(0.5, 4000).vertices, {}};
    EXPECT_THAT(plan_scene(request, {}, {}, {}).error().detail, HasSubstr("largest plane"));
}

}  // namespace
}  // namespace graspd::cli
