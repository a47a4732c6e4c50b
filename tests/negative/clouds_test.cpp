#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/face_sensor.hpp"
#include "graspd/mesh/surface_distance.hpp"
#include "graspd/mesh/triangulate_cloud.hpp"
#include "negative/verdict.hpp"
#include "support/clouds.hpp"
#include "support/shapes.hpp"

// Damaged and one-sided clouds.

namespace graspd::test {
namespace {

using Eigen::Vector3d;
constexpr auto kInvalid = PlanErrorCode::kInvalidInput;
constexpr auto kDegenerate = PlanErrorCode::kDegenerate;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct BadCloud {
    std::string name;
    PointCloud cloud;
    Verdict verdict;
};
void PrintTo(const BadCloud& row, std::ostream* out) {
    *out << row.name;
}

PointCloud sphere_cloud(int count = 1000) {
    return spiral_sphere(0.05, count);
}
PointCloud with(PointCloud cloud, const std::vector<Vector3d>& more) {
    cloud.points.insert(cloud.points.end(), more.begin(), more.end());
    return cloud;
}
/// `count` points a millimetre apart on a line that begins at x = 0.2.
std::vector<Vector3d> row_of(int count) {
    std::vector<Vector3d> row;
    for (int i = 0; i < count; ++i) row.emplace_back(0.2 + 0.001 * i, 0.0, 0.0);
    return row;
}
/// The sphere's points above z.
PointCloud cap(double above_z_m, std::optional<Vector3d> sensor = {}) {
    PointCloud cloud = sphere_cloud(4000);
    std::erase_if(cloud.points, [&](const Vector3d& p) { return p.z() < above_z_m; });
    cloud.sensor_origin = std::move(sensor);
    return cloud;
}
/// A grid of 30 x 30 points with every fourth not measured, as an organised camera cloud has it.
PointCloud organised_bump() {
    PointCloud cloud;
    for (int i = 0; i < 30; ++i) {
        for (int j = 0; j < 30; ++j) {
            const Vector3d p(0.002 * (i - 14.5), 0.002 * (j - 14.5), 0.0);
            const double z = std::sqrt(std::max(0.0, 0.05 * 0.05 - p.squaredNorm()));
            const bool hit = (i + j) % 4 != 0;
            cloud.points.push_back(hit ? Vector3d(p.x(), p.y(), z) : Vector3d(kNan, kNan, kNan));
        }
    }
    return cloud;
}
PointCloud plane(double step_m) {
    PointCloud cloud;
    for (int i = 0; i < 100; ++i) cloud.points.emplace_back(i % 10 * step_m, i / 10 * step_m, 0.0);
    return cloud;
}

const BadCloud kRefused[] = {
    {"Nothing", {}, refused(kInvalid, {"cloud is empty"})},
    {"NinePoints", sphere_cloud(9), refused(kInvalid, {"9 finite distinct points of 9"})},
    {"OnePlace",
     {std::vector<Vector3d>(50, {1, 2, 3}), {}},
     refused(kInvalid, {"1 finite distinct points of 50"})},
    {"AllNan",
     {std::vector<Vector3d>(50, {kNan, 0, 0}), {}},
     refused(kInvalid, {"0 finite distinct points of 50"})},
    {"Plane", plane(0.01), refused(kDegenerate, {"cloud of 100 points is flat"})},
    {"Line", {row_of(20), {}}, refused(kDegenerate, {"cloud of 20 points is flat"})},
    // What makes it thick is a speck: without it the plane is flat.
    {"PlaneWithASpeck", with(plane(0.01), {{0.05, 0.05, 0.2}}),
     refused(kDegenerate, {"cloud of 100 points is flat"})},
    {"SquaresOverflow", spiral_sphere(1e200, 100),
     refused(kInvalid, {"bounding box is too large to measure"})},
};

// 1000 points on a sphere of 0.05 m have 31 mm^2 each: five spacings are about 28 mm.
// Half a sphere and the disc that closes it have 2 : 1 of the area, so 2/3 of it was seen.
const BadCloud kRepaired[] = {
    {"NotFinite", with(sphere_cloud(), {{kNan, 0, 0}, {0, kInfinity, 0}, {0, 0, -kInfinity}}),
     repaired({{"points_not_finite", 3}, {"surface_deviation", 0}})},
    {"Twice", with(sphere_cloud(), sphere_cloud().points),
     repaired({{"points_duplicate", 1000}, {"surface_deviation", 0}})},
    {"OneOutlier", with(sphere_cloud(), {{0.2, 0, 0}}),
     repaired({{"outliers_removed", 1}, {"surface_deviation", 0}})},
    {"OutliersApart", with(sphere_cloud(), {{0.2, 0, 0}, {0, 0.3, 0}, {0, 0, -0.15}}),
     repaired({{"outliers_removed", 3}})},
    {"OutliersInARow", with(sphere_cloud(), row_of(9)), repaired({{"outliers_removed", 9}})},
    {"OutlierFarAway", with(sphere_cloud(), {{100.0, 0, 0}}), repaired({{"outliers_removed", 1}})},
    {"HalfASphere", cap(0.0), repaired({{"one_sided", 2.0 / 3.0, 0.02}})},
    {"HalfASphereFromAbove", cap(0.0, Vector3d(0, 0, 0.5)),
     repaired({{"one_sided", 2.0 / 3.0, 0.02}})},
    {"OrganisedWithNan", organised_bump(), repaired({{"points_not_finite", 225}})},
};

class Clouds : public testing::TestWithParam<BadCloud> {};

TEST_P(Clouds, GetTheirVerdict) {
    expect_verdict(close(GetParam().cloud), GetParam().verdict);
}

INSTANTIATE_TEST_SUITE_P(Refused, Clouds, testing::ValuesIn(kRefused), kName);
INSTANTIATE_TEST_SUITE_P(Repaired, Clouds, testing::ValuesIn(kRepaired), kName);

bool has(const Outcome& outcome, const char* code) {
    return std::ranges::count(outcome.findings, code, &Finding::code) > 0;
}

// Ten points are a group of their own, which may be a part of the object.
TEST(Outliers, AGroupOfTenStays) {
    EXPECT_FALSE(has(close(with(sphere_cloud(), row_of(10))), "outliers_removed"));
}

TEST(Outliers, NoneInACleanCloudNorWhenTurnedOff) {
    EXPECT_FALSE(has(close(sphere_cloud()), "outliers_removed"));
    TriangulateCloudConfig config;
    config.outlier_spacings = 0.0;
    const auto surface = triangulate_cloud(with(sphere_cloud(), {{0.2, 0, 0}}), config);
    ASSERT_TRUE(surface.ok());
    EXPECT_EQ(std::ranges::count(surface.value().findings, "outliers_removed", &Finding::code), 0);
}

// The surface is the one without the speck, and the speck stands for no vertex.
TEST(Outliers, LeaveTheSurfaceAsItIsWithoutThem) {
    const auto clean = triangulate_cloud(sphere_cloud(), {});
    const auto dirty = triangulate_cloud(with(sphere_cloud(), {{0.2, 0, 0}}), {});
    ASSERT_TRUE(clean.ok() && dirty.ok());
    EXPECT_EQ(dirty.value().mesh.vertices, clean.value().mesh.vertices);
    EXPECT_EQ(dirty.value().mesh.faces, clean.value().mesh.faces);
    EXPECT_NEAR(dirty.value().spacing_m, clean.value().spacing_m, 1e-9);
    EXPECT_EQ(dirty.value().vertex_of_point.back(), -1);
}

// Every second point of a sphere of 20,000 stands beside the surface through the other half: the
// chord of a triangle with edges of about s sinks below the sphere by s^2 / (6 R).
TEST(SurfaceDeviation, IsThatOfThePointsThatWereThinned) {
    TriangulateCloudConfig config;
    config.max_points = 2000;
    const auto surface = triangulate_cloud(sphere_cloud(20000), config);
    ASSERT_TRUE(surface.ok());
    const auto deviation =
        std::ranges::find(surface.value().findings, "surface_deviation", &Finding::code);
    ASSERT_NE(deviation, surface.value().findings.end());
    const double spacing_m = surface.value().spacing_m;
    EXPECT_GT(deviation->value, 0.05 * spacing_m * spacing_m / 0.05);
    EXPECT_LT(deviation->value, 4.0 * spacing_m * spacing_m / 0.05);
    // The same number by looking at every face.
    const TriangleMesh& mesh = surface.value().mesh;
    double farthest_m = 0.0;
    for (const Vector3d& point : sphere_cloud(20000).points) {
        if (farthest_m > 0.0 && point.z() < 0.03) continue;  // a part of it, for time
        double nearest_m = kInfinity;
        for (const Triangle& t : mesh.faces) {
            nearest_m = std::min(
                nearest_m, distance_to_triangle_m(point, mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                  mesh.vertices[t[2]]));
        }
        farthest_m = std::max(farthest_m, nearest_m);
    }
    EXPECT_LE(farthest_m, deviation->value * (1 + 1e-12));
}

// A unit right triangle: over its face, beside each edge, behind each corner, and without area.
TEST(SurfaceDistance, OfATriangle) {
    const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    const auto distance = [&](double x, double y, double z) {
        return distance_to_triangle_m({x, y, z}, a, b, c);
    };
    EXPECT_NEAR(distance(0.25, 0.25, -2), 2.0, 1e-15);
    EXPECT_NEAR(distance(0.5, -3, 4), 5.0, 1e-15);
    EXPECT_NEAR(distance(1, 1, 0), std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(distance(4, -4, 0), 5.0, 1e-15);
    EXPECT_NEAR(distance(-2, -2, 1), 3.0, 1e-15);
    EXPECT_NEAR(distance_to_triangle_m({0, 2, 0}, a, b, 0.5 * b), 2.0, 1e-15);
    EXPECT_NEAR(distance_to_triangle_m({3, 4, 0}, a, a, a), 5.0, 1e-15);
}

// Against every triangle one by one, from near and far.
TEST(SurfaceDistance, IsTheLeastOverAllFaces) {
    const TriangleMesh mesh = moved(torus(0.06, 0.02, 1500), random_pose(7));
    const SurfaceDistance surface(mesh);
    const PointCloud around = spiral_sphere(1.0, 40);
    for (const double reach_m : {0.01, 0.1, 10.0}) {
        for (const Vector3d& direction : around.points) {
            const Vector3d point = mesh.vertices[7] + reach_m * direction;
            double least_m = kInfinity;
            for (const Triangle& t : mesh.faces) {
                least_m = std::min(
                    least_m, distance_to_triangle_m(point, mesh.vertices[t[0]], mesh.vertices[t[1]],
                                                    mesh.vertices[t[2]]));
            }
            EXPECT_NEAR(surface.to(point, kInfinity), least_m, 1e-12 * least_m);
            EXPECT_NEAR(surface.to(point, 0.5 * least_m), 0.5 * least_m, 1e-12 * least_m);
        }
    }
}

// --- seen from one side ---

/// The closed surface of a cloud as a plan sees it.
ConditionedMesh closed(const PointCloud& cloud) {
    const auto surface = triangulate_cloud(cloud, {});
    EXPECT_TRUE(surface.ok());
    auto solid = condition_mesh(surface.value().mesh, {});
    EXPECT_TRUE(solid.ok());
    auto facing = face_sensor(std::move(solid).value(), cloud.sensor_origin, {}, {});
    EXPECT_TRUE(facing.ok());
    return std::move(facing).value();
}

TEST(OneSided, NotWhenSeenAllRound) {
    EXPECT_FALSE(has(close(sphere_cloud()), "one_sided"));
    // A cube without its bottom: 1/5 of what was seen is missing.
    PointCloud cloud{box({0.1, 0.1, 0.1}, 4000).vertices, Vector3d(0, 0, 1)};
    std::erase_if(cloud.points, [](const Vector3d& p) {
        return p.z() < -0.0499 && p.head<2>().cwiseAbs().maxCoeff() < 0.0499;
    });
    EXPECT_FALSE(has(close(cloud), "one_sided"));
}

// Half a sphere seen from outside is solid: 2/3 pi R^3. The surface that was seen looks outward.
TEST(OneSided, WhatBulgesIsClosedBehind) {
    const double solid_m3 = 2.0 / 3.0 * std::numbers::pi * std::pow(0.05, 3);
    const ConditionedMesh plain = closed(cap(0.0)), facing = closed(cap(0.0, Vector3d(0, 0, 0.5)));
    EXPECT_NEAR(plain.volume_m3, solid_m3, 0.03 * solid_m3);
    EXPECT_EQ(facing.mesh.faces, plain.mesh.faces);
}

// The same points seen from within are a bowl: a shell of 2 % of the diagonal 0.15 m = 3 mm, and
// the normals at its points look to the middle. Its volume is about 2 pi R^2 times that.
TEST(OneSided, AHollowThatFacesTheSensorBecomesAShell) {
    const PointCloud cloud = cap(0.0, Vector3d(0, 0, 0.0));
    PointCloud from_below = cap(0.0, Vector3d(0, 0, -0.2));
    for (const PointCloud& bowl : {cloud, from_below}) {
        const ConditionedMesh shell = closed(bowl);
        EXPECT_TRUE(is_balanced(shell.mesh));
        const double thickness_m = 0.02 * std::sqrt(0.1 * 0.1 * 2 + 0.05 * 0.05);
        const double shell_m3 = 2.0 * std::numbers::pi * 0.05 * 0.05 * thickness_m;
        EXPECT_GT(shell.volume_m3, 0.5 * shell_m3);  // view rays lean against the surface
        EXPECT_LT(shell.volume_m3, 1.3 * shell_m3);
        double inward_m2 = 0.0, outward_m2 = 0.0;
        for (const Triangle& t : shell.mesh.faces) {
            const Vector3d& a = shell.mesh.vertices[t[0]];
            const Vector3d half =
                0.5 * (shell.mesh.vertices[t[1]] - a).cross(shell.mesh.vertices[t[2]] - a);
            const bool seen = std::abs(a.norm() - 0.05) < 1e-6;
            (half.dot(a) < 0.0 ? inward_m2 : outward_m2) += seen ? half.norm() : 0.0;
        }
        // What is left is the rim: 2 pi R 3 mm over 2 pi R^2, 1 in 17.
        EXPECT_GT(inward_m2, 10.0 * outward_m2);
        const auto found = std::ranges::find(shell.findings, "one_sided", &Finding::code);
        ASSERT_NE(found, shell.findings.end());
        EXPECT_THAT(found->detail, testing::HasSubstr("hollow towards the sensor"));
    }
}

}  // namespace
}  // namespace graspd::test
