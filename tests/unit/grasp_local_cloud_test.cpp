#include "graspd/grasp/local_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

// 9 x 5 lines: along y every 20 / 9 = 2.22, along z at -8, -4, 0, 4, 8.
constexpr PadFootprint kPad{0.01, 0.01, 0.05};
constexpr double kLines = 45.0;

Result<LocalCloud> cloud_of(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WG,
                            const PadFootprint& pad = kPad, const LocalCloudConfig& config = {}) {
    return local_cloud(mesh, TriangleBvh(mesh, 1e-8), X_WG, pad, config);
}
LocalCloud value_of(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WG,
                    const PadFootprint& pad = kPad, const LocalCloudConfig& config = {}) {
    auto cloud = cloud_of(mesh, X_WG, pad, config);
    EXPECT_TRUE(cloud.ok()) << (cloud.ok() ? "" : cloud.error().detail);
    return cloud.ok() ? std::move(cloud).value() : LocalCloud{};
}
Eigen::Isometry3d at(const Vector3d& place) {
    return Eigen::Isometry3d(Eigen::Translation3d(place));
}

// A block 40 wide, gripped in the middle, 3 off the centre: both pads touch with all their lines.
TEST(LocalCloud, FlatSidesTouchTheWholePads) {
    const LocalCloud cloud = value_of(test::box({0.04, 0.06, 0.08}, 300), at({0.003, 0, 0}));
    EXPECT_NEAR(cloud.left.x_G, -0.023, 1e-9);
    EXPECT_NEAR(cloud.right.x_G, 0.017, 1e-9);
    EXPECT_DOUBLE_EQ(cloud.left.share, 1.0);
    EXPECT_DOUBLE_EQ(cloud.right.share, 1.0);
    EXPECT_LT((cloud.left.point_G - Vector3d(-0.023, 0, 0)).norm(), 1e-9);
    EXPECT_LT((cloud.right.point_G - Vector3d(0.017, 0, 0)).norm(), 1e-9);
    EXPECT_LT((cloud.left.normal_G - Vector3d(-1, 0, 0)).norm(), 1e-9);
    EXPECT_LT((cloud.right.normal_G - Vector3d(1, 0, 0)).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(cloud.line_spacing_m, 0.02 / 9.0);
    EXPECT_EQ(cloud.points_G.size(), 90U);
    for (const Vector3d& p : cloud.points_G) {
        EXPECT_NEAR(std::min(std::abs(p.x() + 0.023), std::abs(p.x() - 0.017)), 0.0, 1e-9);
        EXPECT_LE(std::abs(p.y()), 0.01);
        EXPECT_LE(std::abs(p.z()), 0.01);
    }
}

// The same in any frame.
TEST(LocalCloud, MovesWithTheObject) {
    const TriangleMesh mesh = test::box({0.04, 0.06, 0.08}, 300);
    const Eigen::Isometry3d X = test::random_pose(6);
    const LocalCloud cloud = value_of(test::moved(mesh, X), X * at({0.003, 0.001, 0.002}));
    EXPECT_NEAR(cloud.left.x_G, -0.023, 1e-9);
    EXPECT_LT((cloud.right.normal_G - Vector3d(1, 0, 0)).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(cloud.left.share, 1.0);
}

// A block's top edge at z = 40. With the TCP at 39 the lines at -8, -4 and 0 meet it: 27 of 45,
// their mean 4 below the TCP. With the TCP beside y = 30 by 1: lines 0 to 3 of 9 lie more than 1
// inside (-8.89, -6.67, -4.44, -2.22): 20 of 45.
TEST(LocalCloud, CountsTheLinesThatTouch) {
    const TriangleMesh mesh = test::box({0.04, 0.06, 0.08}, 300);
    const LocalCloud top = value_of(mesh, at({0, 0, 0.039}));
    EXPECT_NEAR(top.left.share, 27 / kLines, 1e-12);
    EXPECT_NEAR(top.right.share, 27 / kLines, 1e-12);
    EXPECT_NEAR(top.left.point_G.z(), -0.004, 1e-9);
    const LocalCloud side = value_of(mesh, at({0, 0.031, 0}));
    EXPECT_NEAR(side.left.share, 20 / kLines, 1e-12);
}

// A neck 20 wide and 16 long between plates 60 wide. Lines at z = -8 and 8 lie in the planes of the
// plates' inner faces; moved by 2 those at -6, -2, 2, 6 meet the neck and 10 the upper plate. With
// a pad 3 high, all meet the neck.
TEST(LocalCloud, TheFirstTouchHidesWhatLiesDeeper) {
    const TriangleMesh mesh = test::box_hourglass({0.06, 0.06, 0.02}, 0.02, 0.016, 2000);
    const LocalCloud plate = value_of(mesh, at({0, 0, 0.002}));
    EXPECT_NEAR(plate.left.x_G, -0.03, 1e-9);
    EXPECT_NEAR(plate.left.share, 9 / kLines, 1e-12);
    EXPECT_NEAR(plate.left.point_G.z(), 0.008, 1e-9);
    EXPECT_EQ(plate.points_G.size(), 90U);  // the neck is seen, too
    const LocalCloud neck = value_of(mesh, at({0, 0, 0.002}), {0.0099, 0.003, 0.05});
    EXPECT_NEAR(neck.left.x_G, -0.01, 1e-9);
    EXPECT_NEAR(neck.right.x_G, 0.01, 1e-9);
    EXPECT_DOUBLE_EQ(neck.left.share, 1.0);
}

// A round bar of radius 10 along z: at height y the touch lies 10 - sqrt(100 - y^2) deeper. Within
// 1.5 lie the lines up to |y| = 5.27: -4.44, -2.22, 0, 2.22, 4.44, so 5 of 9. Their mean normals
// point along x by symmetry, and the first touch is at the top of the bar.
TEST(LocalCloud, ACurvedSideTouchesAsDeepAsThePadFeels) {
    const TriangleMesh mesh = test::cylinder(0.01, 0.08, 40000);
    const LocalCloud cloud = value_of(mesh, at({0, 0, 0}));
    EXPECT_NEAR(cloud.right.x_G, 0.01, 1e-4);
    EXPECT_NEAR(cloud.right.share, 5.0 / 9.0, 1e-12);
    EXPECT_LT((cloud.right.normal_G - Vector3d(1, 0, 0)).norm(), 1e-2);
    EXPECT_NEAR(cloud.right.point_G.y(), 0.0, 1e-6);
    // Mean of sqrt(100 - y^2) at y = 0, 2.222 twice and 4.444 twice: 9.528.
    EXPECT_NEAR(cloud.right.point_G.x(), 0.009528, 1e-4);  // a polygon of some thirty sides
    const LocalCloud deep = value_of(mesh, at({0, 0, 0}), kPad, {.max_depth_m = 0.01});
    EXPECT_DOUBLE_EQ(deep.right.share, 1.0);
}

// Leans by 20 degrees: within 1.5 behind the first touch lie the lines whose z is at most 1.5 / tan
// 20 = 4.1 from the foremost, at -8 and -4 for a wedge that is wider below.
TEST(LocalCloud, ALeaningSideTouchesWithItsEdge) {
    const double tangent = std::tan(20.0 * std::numbers::pi / 180.0);
    const TriangleMesh mesh = test::wedge(0.05, 0.05 - 2.0 * 0.06 * tangent, 0.05, 0.06, 500);
    const LocalCloud cloud = value_of(mesh, at({0, 0, 0}));
    EXPECT_NEAR(cloud.right.x_G, 0.025 - 0.022 * tangent, 1e-9);  // 22 above the bottom
    EXPECT_NEAR(cloud.right.share, 0.4, 1e-12);
    EXPECT_NEAR(cloud.right.point_G.z(), -0.006, 1e-9);
    EXPECT_NEAR(cloud.right.normal_G.z() / cloud.right.normal_G.x(), tangent, 1e-9);
}

TEST(LocalCloud, WithoutTwoTouchesThereIsNone) {
    const TriangleMesh mesh = test::box({0.04, 0.06, 0.08}, 300);
    const auto expect = [&](const Vector3d& place, double reach_m, const char* word) {
        const auto cloud = cloud_of(mesh, at(place), {0.01, 0.01, reach_m});
        ASSERT_FALSE(cloud.ok()) << word;
        EXPECT_EQ(cloud.error().code, PlanErrorCode::kDegenerate);
        EXPECT_NE(cloud.error().detail.find(word), std::string::npos) << cloud.error().detail;
    };
    expect({0, 0.2, 0}, 0.05, "meets nothing");
    expect({-0.03, 0, 0}, 0.015, "right finger begins in the object");  // from -45 to -15
    expect({0.03, 0, 0}, 0.015, "left finger begins in the object");
}

TEST(LocalCloud, EveryParameterHasItsRange) {
    const TriangleMesh mesh = test::box({0.04, 0.06, 0.08});
    const auto expect = [&](const LocalCloudConfig& config, const char* name) {
        const auto cloud = cloud_of(mesh, at({0, 0, 0}), kPad, config);
        ASSERT_FALSE(cloud.ok()) << name;
        EXPECT_EQ(cloud.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_NE(cloud.error().detail.find(name), std::string::npos) << cloud.error().detail;
    };
    expect({.lines_across = 1}, "lines_across");
    expect({.lines_along = 0}, "lines_along");
    expect({.max_depth_m = 0.0}, "max_depth_m");
    expect({.max_depth_m = std::numeric_limits<double>::quiet_NaN()}, "max_depth_m");
}

}  // namespace
}  // namespace graspd
