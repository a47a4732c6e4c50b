#include "graspd/mesh/segment_scene.hpp"

#include <gmock/gmock.h>

#include "support/clouds.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// A table of 0.8 x 0.6 m in steps of 5 mm at z = 0.
PointCloud table() {
    PointCloud cloud;
    for (int i = -80; i <= 80; ++i) {
        for (int j = -60; j <= 60; ++j) cloud.points.emplace_back(0.005 * i, 0.005 * j, 0.0);
    }
    return cloud;
}

void add(PointCloud& scene, const std::vector<Vector3d>& points, const Vector3d& shift) {
    for (const Vector3d& point : points) scene.points.push_back(point + shift);
}

/// Balls of 4 and 3 cm radius at (0.2, 0, 0.05) and (-0.2, 0.1, 0.05), and under the table a crate.
PointCloud scene() {
    PointCloud cloud = table();
    add(cloud, test::spiral_sphere(0.04, 1500).points, {0.2, 0.0, 0.055});
    add(cloud, test::spiral_sphere(0.03, 800).points, {-0.2, 0.1, 0.045});
    add(cloud, test::box({0.1, 0.1, 0.1}, 1000).vertices, {0.0, 0.0, -0.2});
    return cloud;
}

// A ball of radius R at height h over the plane has no points below 10 mm: both stand 15 mm off.
TEST(SegmentScene, FindsThePlaneAndWhatStandsOnIt) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const Eigen::Isometry3d pose = test::random_pose(seed);
        PointCloud cloud = scene();
        for (Vector3d& point : cloud.points) point = pose * point;
        cloud.sensor_origin = pose * Vector3d(0.5, 0.5, 1.0);
        const auto found = segment_scene(cloud, {});
        ASSERT_TRUE(found.ok()) << found.error().detail;
        const Vector3d normal = pose.linear().col(2);
        EXPECT_LT((found.value().normal - normal).norm(), 1e-4);
        EXPECT_NEAR(found.value().offset_m, normal.dot(pose.translation()), 1e-4);
        ASSERT_EQ(found.value().objects.size(), 2u);
        EXPECT_EQ(found.value().objects[0].points.size(), 1500u);
        EXPECT_EQ(found.value().objects[1].points.size(), 800u);
        EXPECT_EQ(found.value().objects[0].sensor_origin, cloud.sensor_origin);
        EXPECT_TRUE(found.value().background.empty());
        for (const Vector3d& point : found.value().objects[1].points) {
            EXPECT_NEAR((point - pose * Vector3d(-0.2, 0.1, 0.045)).norm(), 0.03, 1e-9);
        }
    }
}

// Without a sensor the side with more points counts; from below, the crate is what is seen.
TEST(SegmentScene, LooksToTheSensorElseToTheMany) {
    EXPECT_GT(segment_scene(scene(), {}).value().normal.z(), 0.99);
    PointCloud from_below = scene();
    from_below.sensor_origin = Vector3d(0, 0, -1);
    const auto found = segment_scene(from_below, {});
    ASSERT_TRUE(found.ok());
    EXPECT_LT(found.value().normal.z(), -0.99);
    EXPECT_EQ(found.value().objects.size(), 1u);
}

TEST(SegmentScene, LargeGroupsAreBackgroundAndSpecksAreNothing) {
    PointCloud cloud = scene();
    std::vector<Vector3d> wall;
    for (int i = 0; i < 150; ++i) {
        for (int k = 3; k < 40; ++k) wall.emplace_back(0.005 * i, 0.0, 0.01 * k);
    }
    add(cloud, wall, {-0.38, 0.3, 0.0});
    add(cloud, test::spiral_sphere(0.01, 99).points, {0.0, -0.1, 0.05});
    const auto found = segment_scene(cloud, {});
    ASSERT_TRUE(found.ok()) << found.error().detail;
    EXPECT_EQ(found.value().objects.size(), 2u);
    ASSERT_EQ(found.value().background.size(), 1u);
    EXPECT_EQ(found.value().background[0].points.size(), wall.size());
}

TEST(SegmentScene, TheSameAgain) {
    const auto first = segment_scene(scene(), {}), second = segment_scene(scene(), {});
    EXPECT_EQ(first.value().normal, second.value().normal);
    EXPECT_EQ(first.value().offset_m, second.value().offset_m);
    EXPECT_EQ(first.value().objects[0].points, second.value().objects[0].points);
}

TEST(SegmentScene, RefusesWhatIsNoScene) {
    EXPECT_THAT(segment_scene({}, {}).error().detail, HasSubstr("0 finite distinct points"));
    EXPECT_THAT(segment_scene(table(), {}).error().detail, HasSubstr("nothing stands on"));
    const auto ball = segment_scene(test::spiral_sphere(0.5, 2000), {});
    EXPECT_EQ(ball.error().code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(ball.error().detail, HasSubstr("a tenth is needed"));
    SegmentSceneConfig config;
    config.gap_m = -1.0;
    EXPECT_THAT(segment_scene(scene(), config).error().detail,
                HasSubstr("segment_scene.gap_m = -1"));
}

}  // namespace
}  // namespace graspd
