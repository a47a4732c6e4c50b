#include "graspd/base/solid_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace graspd {
namespace {

constexpr double kPi = std::numbers::pi;

/// Sum of the tetrahedra between the origin and each face: right for any closed outward mesh.
double volume_m3(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.faces) {
        sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
    }
    return sum;
}

/// Every edge has one face to either side, in opposite directions; and Euler's number is that of a
/// ball, so there is neither a second part nor a vertex that no face uses.
void expect_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
    for (const Triangle& t : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) ++ways[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [way, count] : ways) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(ways.contains({way.second, way.first})) << way.first << " " << way.second;
    }
    EXPECT_EQ(mesh.vertices.size() + mesh.faces.size(), ways.size() / 2 + 2);
}

/// The mesh is convex about its inside: from the origin each face is seen from behind.
void expect_outward(const TriangleMesh& mesh) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        EXPECT_GT(face_normal(mesh, f).dot(mesh.vertices[mesh.faces[f][0]]), 0.0) << f;
    }
}

/// Least distance of the planes of all faces from a place inside.
double least_depth(const TriangleMesh& mesh, const Eigen::Vector3d& inside) {
    double least = 1e9;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Eigen::Vector3d& corner = mesh.vertices[mesh.faces[f][0]];
        least = std::min(least, face_normal(mesh, f).dot(corner - inside));
    }
    return least;
}

TEST(SolidMeshes, ABoxIsExact) {
    const TriangleMesh mesh = box_mesh({0.2, 0.3, 0.5});
    expect_closed(mesh);
    expect_outward(mesh);
    EXPECT_NEAR(volume_m3(mesh), 0.03, 1e-15);
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& v : mesh.vertices) bounds.extend(v);
    EXPECT_EQ(bounds.min(), Eigen::Vector3d(-0.1, -0.15, -0.25));
    EXPECT_EQ(bounds.max(), Eigen::Vector3d(0.1, 0.15, 0.25));
}

// All vertices on the sphere, all faces outside the smaller one: so the whole mesh lies between.
TEST(SolidMeshes, ASphereStaysWithinItsChordError) {
    const double r = 0.04;
    const TriangleMesh mesh = sphere_mesh(r);
    expect_closed(mesh);
    expect_outward(mesh);
    for (const Eigen::Vector3d& v : mesh.vertices) EXPECT_NEAR(v.norm(), r, 1e-15);
    EXPECT_GE(least_depth(mesh, Eigen::Vector3d::Zero()), (1.0 - kSphereChordError) * r);
    const double ball_m3 = 4.0 / 3.0 * kPi * r * r * r;
    EXPECT_LT(volume_m3(mesh), ball_m3);
    EXPECT_GT(volume_m3(mesh), 0.992 * ball_m3);
}

// Prism over the regular 64-gon: area 32 r^2 sin(2 pi / 64).
TEST(SolidMeshes, ACylinderIsAPrismOf64Sides) {
    const double h = 0.3, r = 0.05;
    const TriangleMesh mesh = cylinder_mesh(h, r);
    expect_closed(mesh);
    expect_outward(mesh);
    EXPECT_NEAR(volume_m3(mesh), h * 32.0 * r * r * std::sin(kPi / 32.0), 1e-15);
    EXPECT_GT(volume_m3(mesh), 0.9983 * kPi * r * r * h);
    for (const Eigen::Vector3d& v : mesh.vertices) {
        EXPECT_NEAR(v.head<2>().norm(), r, 1e-15);
        EXPECT_EQ(std::abs(v.z()), 0.15);
    }
    EXPECT_NEAR(least_depth(mesh, Eigen::Vector3d::Zero()), r * std::cos(kPi / 64.0), 1e-15);
    EXPECT_GE(least_depth(mesh, Eigen::Vector3d::Zero()), (1.0 - kCircleChordError) * r);
}

TEST(SolidMeshes, AConePointsUp) {
    const double h = 0.12, r = 0.05;
    const TriangleMesh mesh = cone_mesh(h, r);
    expect_closed(mesh);
    expect_outward(mesh);
    EXPECT_NEAR(volume_m3(mesh), h / 3.0 * 32.0 * r * r * std::sin(kPi / 32.0), 1e-15);
    EXPECT_GT(volume_m3(mesh), 0.9983 * kPi * r * r * h / 3.0);
    EXPECT_EQ(mesh.vertices.back(), Eigen::Vector3d(0.0, 0.0, 0.06));
    for (std::size_t i = 0; i + 1 < mesh.vertices.size(); ++i) {
        EXPECT_NEAR(mesh.vertices[i].head<2>().norm(), r, 1e-15);
        EXPECT_EQ(mesh.vertices[i].z(), -0.06);
    }
}

}  // namespace
}  // namespace graspd
