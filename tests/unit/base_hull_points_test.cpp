#include "graspd/base/hull_points.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace graspd {
namespace {

/// Corners of a box of 2 x 4 x 6 m about (10, 0, 0), with its middle among them.
std::vector<Eigen::Vector3d> box_and_middle() {
    std::vector<Eigen::Vector3d> points;
    for (const double x : {9.0, 11.0}) {
        for (const double y : {-2.0, 2.0}) {
            for (const double z : {-3.0, 3.0}) points.emplace_back(x, y, z);
        }
    }
    points.insert(points.begin() + 3, Eigen::Vector3d(10.0, 0.0, 0.0));
    return points;
}

TEST(HullPoints, LeavesOutWhatLiesInside) {
    const auto points = box_and_middle();
    const auto hull = hull_points(points);
    ASSERT_TRUE(hull.ok());
    ASSERT_EQ(hull.value().size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(hull.value()[i], points[i < 3 ? i : i + 1]);
}

// Six sides of two triangles; the tetrahedra from the middle to all faces fill 48 m^3, and none
// counts as negative where every face is counter-clockwise seen from outside.
TEST(HullMesh, ABoxIsTwelveTrianglesThatLookOutward) {
    const auto hull = hull_mesh(box_and_middle());
    ASSERT_TRUE(hull.ok());
    const TriangleMesh& mesh = hull.value();
    EXPECT_EQ(mesh.vertices.size(), 8u);
    ASSERT_EQ(mesh.faces.size(), 12u);
    const Eigen::Vector3d middle(10.0, 0.0, 0.0);
    double volume_m3 = 0.0;
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d a = mesh.vertices.at(face[0]) - middle;
        const Eigen::Vector3d b = mesh.vertices.at(face[1]) - middle;
        const Eigen::Vector3d c = mesh.vertices.at(face[2]) - middle;
        const double part_m3 = a.dot(b.cross(c)) / 6.0;
        EXPECT_GT(part_m3, 0.0);
        volume_m3 += part_m3;
    }
    EXPECT_NEAR(volume_m3, 48.0, 1e-12);
}

TEST(HullMesh, FlatOrTooFewPointsHaveNone) {
    const std::vector<Eigen::Vector3d> flat = {
        {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}};
    for (const auto& hull : {hull_mesh(flat), hull_mesh({flat.begin(), flat.begin() + 3})}) {
        ASSERT_FALSE(hull.ok());
        EXPECT_EQ(hull.error().code, PlanErrorCode::kDegenerate);
    }
}

}  // namespace
}  // namespace graspd
