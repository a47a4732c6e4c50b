#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "graspd/contour/project_points.hpp"

namespace graspd {
namespace {

// A frame turned by 90 degrees about Oy has Wx = -Oz, Wy = Oy, Wz = Ox: of a point of O the plane
// keeps (-z, y), measured from the frame's origin, and loses x.
TEST(ProjectPoints, DropsTheCoordinateAlongTheNormal) {
    Eigen::Isometry3d X_OW = Eigen::Isometry3d::Identity();
    X_OW.translation() = Eigen::Vector3d(5, 1, 2);
    X_OW.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY()));
    const std::vector<Eigen::Vector3d> points_O = {{7, 4, 12}, {-90, 4, 12}};

    const auto points_W = project_points(points_O, X_OW);

    ASSERT_EQ(points_W.size(), 2U);
    EXPECT_NEAR((points_W[0] - Eigen::Vector2d(-10, 3)).norm(), 0.0, 1e-13);
    EXPECT_NEAR((points_W[1] - points_W[0]).norm(), 0.0, 1e-12);
}

// Two points of the plane itself keep their distance, whatever the pose.
TEST(ProjectPoints, KeepsDistancesWithinThePlane) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int round = 0; round < 50; ++round) {
        Eigen::Isometry3d X_OW = Eigen::Isometry3d::Identity();
        X_OW.rotate(
            Eigen::Quaterniond(number(engine), number(engine), number(engine), number(engine))
                .normalized());
        X_OW.translation() = Eigen::Vector3d(number(engine), number(engine), number(engine));
        const Eigen::Vector3d a_W(number(engine), number(engine), number(engine));
        const Eigen::Vector3d b_W(number(engine), number(engine), number(engine));

        const std::vector<Eigen::Vector3d> points_O = {X_OW * a_W, X_OW * b_W};
        const auto points_W = project_points(points_O, X_OW);

        EXPECT_NEAR((points_W[0] - points_W[1]).norm(), (a_W - b_W).head<2>().norm(), 1e-14);
    }
}

TEST(ProjectPoints, NoPointsGiveNone) {
    EXPECT_TRUE(project_points({}, Eigen::Isometry3d::Identity()).empty());
}

}  // namespace
}  // namespace graspd
