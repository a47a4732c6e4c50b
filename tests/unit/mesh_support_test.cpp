#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.hpp"

// The shapes themselves: whoever uses them may rely on what their comments say.

namespace graspd::test {
namespace {

constexpr double kPi = std::numbers::pi;

struct Shape {
    const char* name;
    TriangleMesh mesh;
    double volume_m3;
    double tolerance;  ///< [1] polygons stand for circles
};

std::vector<Shape> all_shapes(std::size_t faces) {
    // A circle drawn as a polygon with n sides loses the share 1 - sin(2 pi / n) / (2 pi / n) < 7 /
    // n^2 of its area; with 2000 faces the torus' tube has 15 sides, every other circle 30 or more.
    const double round = 0.02;
    const double tube = 7.0 / (15 * 15);
    return {
        {"box", box({0.04, 0.06, 0.1}, faces), 0.04 * 0.06 * 0.1, 1e-12},
        {"sphere", sphere(0.05, faces), 4.0 / 3.0 * kPi * std::pow(0.05, 3), round},
        {"cylinder", cylinder(0.03, 0.1, faces), kPi * 0.0009 * 0.1, round},
        {"u_channel", u_channel(0.03, 0.02, 0.005, 0.08, faces),
         0.08 * (0.03 * 0.035 - 0.02 * 0.03), 1e-12},
        {"wedge", wedge(0.02, 0.04, 0.06, 0.05, faces), 0.03 * 0.06 * 0.05, 1e-12},
        {"oblique_prism", oblique_prism({0.03, 0.06, 0.05}, 0.02, faces), 0.03 * 0.06 * 0.05,
         1e-12},
        {"blind_hole_block", blind_hole_block({0.06, 0.05, 0.04}, 0.02, 0.03, faces),
         0.06 * 0.05 * 0.04 - 0.02 * 0.02 * 0.03, 1e-12},
        {"cup", cup(0.04, 0.09, 0.004, faces), kPi * (0.0016 * 0.09 - 0.036 * 0.036 * 0.086),
         round},
        {"bowl", bowl(0.07, 0.005, faces),
         2.0 / 3.0 * kPi * (std::pow(0.07, 3) - std::pow(0.065, 3)), round},
        {"torus", torus(0.05, 0.015, faces), 2.0 * kPi * kPi * 0.05 * 0.015 * 0.015, tube},
        {"l_shape", l_shape(0.06, 0.08, 0.01, 0.05, faces), 0.05 * (0.06 * 0.01 + 0.07 * 0.01),
         1e-12},
        {"hourglass", hourglass(0.04, 0.01, 0.05, 0.015, faces),
         kPi * (0.0016 * 0.03 + 0.0001 * 0.05), round},
        {"box_hourglass", box_hourglass({0.06, 0.05, 0.015}, 0.02, 0.05, faces),
         2 * 0.06 * 0.05 * 0.015 + 0.02 * 0.02 * 0.05, 1e-12},
        {"plate_with_hole", plate_with_hole({0.08, 0.06, 0.01}, 0.02, faces),
         (0.08 * 0.06 - 0.02 * 0.02) * 0.01, 1e-12},
        {"ring", ring(0.03, 0.04, 0.02, faces), kPi * (0.0016 - 0.0009) * 0.02, round},
    };
}

// Closed, every edge shared by two faces that run it in opposite directions, outward (a positive
// volume, equal to the solid's).
TEST(Shapes, AreClosedOutwardAndHaveTheirVolume) {
    for (const std::size_t faces : {2000u, 20000u}) {
        for (const Shape& shape : all_shapes(faces)) {
            SCOPED_TRACE(shape.name);
            EXPECT_TRUE(is_closed_manifold(shape.mesh));
            EXPECT_NEAR(signed_volume_m3(shape.mesh) / shape.volume_m3, 1.0, shape.tolerance);
        }
    }
}

// The number of faces that was asked for, within a factor of two either way.
TEST(Shapes, HaveAboutTheFacesAskedFor) {
    for (const std::size_t faces : {1000u, 70000u}) {
        for (const Shape& shape : all_shapes(faces)) {
            SCOPED_TRACE(shape.name);
            EXPECT_GT(shape.mesh.faces.size(), faces / 2);
            EXPECT_LT(shape.mesh.faces.size(), 2 * faces);
        }
    }
}

// Two balls of 0.03 m whose centres are 0.12 m apart; the bar meets each ball where its radius is
// 0.01 m, so the bar's surface reaches from z = -0.06 + sqrt(0.03^2 - 0.01^2) to the mirror image.
TEST(Shapes, DumbbellIsTwoBallsAndABar) {
    const TriangleMesh mesh = dumbbell(0.03, 0.01, 0.12, 4000);
    EXPECT_TRUE(is_closed_manifold(mesh));
    EXPECT_GT(signed_volume_m3(mesh), 0.0);
    const double meet = 0.06 - std::sqrt(0.0009 - 0.0001);
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
        if (std::abs(vertex.z()) > meet + 1e-9) continue;
        EXPECT_NEAR(vertex.head<2>().norm(), 0.01, 1e-9);
    }
}

// Rigid motions, another order and opposite winding change the volume by nothing or its sign.
TEST(MeshDamage, DoesWhatItSays) {
    const TriangleMesh mesh = box({0.02, 0.03, 0.05}, 500);
    const double volume = 0.02 * 0.03 * 0.05;
    EXPECT_NEAR(signed_volume_m3(moved(mesh, random_pose(3))), volume, 1e-12);
    EXPECT_NEAR(signed_volume_m3(shuffled(mesh, 5)), volume, 1e-15);
    EXPECT_NEAR(signed_volume_m3(inside_out(mesh)), -volume, 1e-15);
    EXPECT_NEAR(signed_volume_m3(scaled(mesh, 2.0)), 8.0 * volume, 1e-14);
    EXPECT_EQ(without(mesh, choose_faces(mesh, 7, 1)).faces.size(), mesh.faces.size() - 7);
    EXPECT_EQ(to_soup(mesh).vertices.size(), 3 * mesh.faces.size());
    EXPECT_FALSE(is_balanced(with_flipped(mesh, choose_faces(mesh, 1, 1))));
    EXPECT_FALSE(is_balanced(without(mesh, choose_faces(mesh, 1, 1))));
}

}  // namespace
}  // namespace graspd::test
