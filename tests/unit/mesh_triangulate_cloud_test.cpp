#include "graspd/mesh/triangulate_cloud.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "graspd/mesh/condition_mesh.hpp"
#include "support/clouds.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using test::spiral_sphere;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PointCloud cloud_of(const TriangleMesh& mesh) {
    return {mesh.vertices, {}};
}

TriangulatedCloud triangulated(const PointCloud& cloud, const TriangulateCloudConfig& config = {}) {
    auto result = triangulate_cloud(cloud, config);
    EXPECT_TRUE(result.ok()) << result.error().detail;
    return result.ok() ? std::move(result).value() : TriangulatedCloud{};
}

PlanError error_of(const PointCloud& cloud, const TriangulateCloudConfig& config = {}) {
    const auto result = triangulate_cloud(cloud, config);
    EXPECT_FALSE(result.ok());
    return result.ok() ? PlanError{} : result.error();
}

double value_of(const TriangulatedCloud& cloud, const std::string& code) {
    const auto it = std::ranges::find(cloud.findings, code, &Finding::code);
    return it == cloud.findings.end() ? 0.0 : it->value;
}

ConditionedMesh conditioned(const TriangleMesh& soup) {
    auto result = condition_mesh(soup, {});
    EXPECT_TRUE(result.ok()) << result.error().detail;
    return result.ok() ? std::move(result).value() : ConditionedMesh{};
}

/// Clouds of closed shapes and the volume of the body that they were taken from. The surface runs
/// through every point, so it stays within a spacing of the true one.
struct KnownBody {
    const char* name;
    PointCloud cloud;
    double volume_m3;
    bool has_sharp_edges;  ///< greedy projection does not go round them: it bends by 45 degrees
};
std::vector<KnownBody> known_bodies() {
    constexpr double kPi = std::numbers::pi;
    return {{"sphere", spiral_sphere(0.05, 4000), 4.0 / 3.0 * kPi * std::pow(0.05, 3), false},
            {"box", cloud_of(test::box({0.06, 0.08, 0.1}, 6000)), 0.06 * 0.08 * 0.1, true},
            {"torus", cloud_of(test::torus(0.06, 0.02, 8000)), 2 * kPi * kPi * 0.06 * 0.02 * 0.02,
             false}};
}

class TriangulateBody : public testing::TestWithParam<bool> {
protected:
    static TriangulateCloudConfig config() {
        TriangulateCloudConfig config;
        config.greedy_projection = GetParam();
        return config;
    }
};

// What is fed to condition_mesh comes out closed and encloses the body's volume within 2 %: chords
// of the torus' 0.02 m tube at 1.5 mm spacing cut off 0.3 %, cut edges of the box under 2 %.
TEST_P(TriangulateBody, EnclosesTheBodysVolume) {
    for (const KnownBody& body : known_bodies()) {
        SCOPED_TRACE(body.name);
        if (GetParam() && body.has_sharp_edges) continue;
        const TriangulatedCloud surface = triangulated(body.cloud, config());
        EXPECT_EQ(surface.mesh.vertices.size(), body.cloud.points.size());
        const ConditionedMesh closed = conditioned(surface.mesh);
        EXPECT_TRUE(test::is_balanced(closed.mesh));
        EXPECT_NEAR(closed.volume_m3, body.volume_m3, 0.02 * body.volume_m3);
    }
}

// Vertices are points of the cloud, and vertex_of_point says which.
TEST_P(TriangulateBody, VerticesAreThePoints) {
    const PointCloud cloud = spiral_sphere(0.05, 500);
    const TriangulatedCloud surface = triangulated(cloud, config());
    ASSERT_EQ(surface.vertex_of_point.size(), cloud.points.size());
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        ASSERT_GE(surface.vertex_of_point[i], 0);
        EXPECT_EQ(surface.mesh.vertices.at(surface.vertex_of_point[i]), cloud.points[i]);
    }
    for (const Triangle& face : surface.mesh.faces) {
        for (const std::uint32_t v : face) EXPECT_LT(v, surface.mesh.vertices.size());
    }
}

// The same call gives the same bytes, and the order of the points does not matter; on a regular
// grid as well, where many triangles are equally good.
TEST_P(TriangulateBody, DoesNotDependOnTheOrderOfPoints) {
    for (PointCloud cloud :
         {spiral_sphere(0.05, 1500), cloud_of(test::box({0.06, 0.06, 0.06}, 2400))}) {
        const TriangulatedCloud first = triangulated(cloud, config());
        EXPECT_EQ(triangulated(cloud, config()).mesh.faces, first.mesh.faces);
        std::mt19937 random(7);
        for (int round = 0; round < 3; ++round) {
            std::ranges::shuffle(cloud.points, random);
            const TriangulatedCloud shuffled = triangulated(cloud, config());
            EXPECT_EQ(shuffled.mesh.vertices, first.mesh.vertices);
            EXPECT_EQ(shuffled.mesh.faces, first.mesh.faces);
        }
    }
}

// A thousand diagonals away the surface is the same: float would leave 4 digits of it.
TEST_P(TriangulateBody, WorksFarFromTheOrigin) {
    PointCloud cloud = spiral_sphere(0.05, 2000);
    for (Eigen::Vector3d& point : cloud.points) point += Eigen::Vector3d(100.0, -120.0, 80.0);
    const TriangulatedCloud surface = triangulated(cloud, config());
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(0.05, 3);
    EXPECT_NEAR(conditioned(surface.mesh).volume_m3, volume, 0.02 * volume);
}

INSTANTIATE_TEST_SUITE_P(, TriangulateBody, testing::Bool(), [](const auto& method) {
    return std::string(method.param ? "GreedyProjection" : "AdvancingFront");
});

// The advancing front leaves no hole in an evenly sampled sphere: 2n - 4 triangles for n points.
TEST(TriangulateCloud, AdvancingFrontClosesASphere) {
    const TriangulatedCloud surface = triangulated(spiral_sphere(0.05, 2000));
    EXPECT_EQ(surface.mesh.faces.size(), 2u * 2000u - 4u);
    EXPECT_EQ(value_of(surface, "points_unused"), 0.0);
}

// A grid of 2 mm on a box: every point has a neighbour at 2 mm and none is nearer.
TEST(TriangulateCloud, SpacingIsTheMedianNeighbourDistance) {
    PointCloud cloud;
    for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 15; ++j) {
            for (int k = 0; k <= 20; ++k) {
                const bool inside = i % 10 != 0 && j % 15 != 0 && k % 20 != 0;
                if (!inside) cloud.points.emplace_back(0.002 * i, 0.002 * j, 0.002 * k);
            }
        }
    }
    EXPECT_NEAR(triangulated(cloud).spacing_m, 0.002, 1e-8);
    // A few points near others move the mean, not the median.
    for (int i = 0; i < 20; ++i) cloud.points.push_back(cloud.points[7 * i] * (1.0 + 1e-3));
    EXPECT_NEAR(triangulated(cloud).spacing_m, 0.002, 1e-8);
}

TEST(TriangulateCloud, DropsWhatIsNotFiniteAndWhatIsThereAlready) {
    const PointCloud clean = spiral_sphere(0.05, 800);
    PointCloud cloud = clean;
    cloud.points.insert(cloud.points.begin() + 100, {kNan, 0.0, 0.0});
    cloud.points.insert(cloud.points.begin() + 200,
                        {0.0, -std::numeric_limits<double>::infinity(), 0.0});
    cloud.points.push_back({0.0, 0.0, std::numeric_limits<double>::infinity()});
    for (int i = 0; i < 5; ++i) cloud.points.push_back(clean.points[10 * i]);
    const TriangulatedCloud surface = triangulated(cloud);
    EXPECT_EQ(value_of(surface, "points_not_finite"), 3.0);
    EXPECT_EQ(value_of(surface, "points_duplicate"), 5.0);
    EXPECT_EQ(surface.vertex_of_point[100], -1);
    EXPECT_EQ(surface.vertex_of_point[200], -1);
    EXPECT_EQ(surface.vertex_of_point[802], -1);
    EXPECT_EQ(surface.vertex_of_point[803 + 3], surface.vertex_of_point[30]);
    const TriangulatedCloud expected = triangulated(clean);
    EXPECT_EQ(surface.mesh.vertices, expected.mesh.vertices);
    EXPECT_EQ(surface.mesh.faces, expected.mesh.faces);
}

// 20,000 points thinned to at most 2000 of them, but not to a handful. Each stands for the points
// of its cube, so none is farther from its vertex than the cube's diagonal; the cubes that 1600 to
// 2000 points of a sphere fill have an edge of about sqrt(4 pi R^2 / 1800) = 4 mm.
TEST(TriangulateCloud, ThinsDenseClouds) {
    const PointCloud cloud = spiral_sphere(0.05, 20000);
    TriangulateCloudConfig config;
    config.max_points = 2000;
    const TriangulatedCloud surface = triangulated(cloud, config);
    EXPECT_LE(surface.mesh.vertices.size(), 2000u);
    EXPECT_GE(surface.mesh.vertices.size(), 1400u);
    EXPECT_EQ(value_of(surface, "points_thinned"),
              static_cast<double>(20000 - surface.mesh.vertices.size()));
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        ASSERT_GE(surface.vertex_of_point[i], 0);
        const Eigen::Vector3d& vertex = surface.mesh.vertices.at(surface.vertex_of_point[i]);
        EXPECT_LT((vertex - cloud.points[i]).norm(), 0.006 * std::sqrt(3.0));
    }
    const ConditionedMesh closed = conditioned(surface.mesh);
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(0.05, 3);
    EXPECT_NEAR(closed.volume_m3, volume, 0.02 * volume);
}

TEST(TriangulateCloud, KeepsAllPointsAtTheLimit) {
    TriangulateCloudConfig config;
    config.max_points = 500;
    EXPECT_EQ(triangulated(spiral_sphere(0.05, 500), config).mesh.vertices.size(), 500u);
    EXPECT_EQ(value_of(triangulated(spiral_sphere(0.05, 500), config), "points_thinned"), 0.0);
    EXPECT_GT(value_of(triangulated(spiral_sphere(0.05, 501), config), "points_thinned"), 0.0);
}

// The two multiples of one cloud, one with half of it missing: an open surface, not an error.
TEST(TriangulateCloud, AHalfSphereStaysOpen) {
    PointCloud cloud = spiral_sphere(0.05, 3000);
    std::erase_if(cloud.points, [](const Eigen::Vector3d& p) { return p.z() < 0.0; });
    const TriangulatedCloud surface = triangulated(cloud);
    EXPECT_GT(surface.mesh.faces.size(), cloud.points.size());
    const ConditionedMesh closed = conditioned(surface.mesh);  // the fill is the flat side
    const double volume = 2.0 / 3.0 * std::numbers::pi * std::pow(0.05, 3);
    EXPECT_NEAR(closed.volume_m3, volume, 0.03 * volume);
}

// --- every error, with the value that a person needs ---

TEST(TriangulateCloud, RefusesAnEmptyCloud) {
    EXPECT_EQ(error_of({}).code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(error_of({}).detail, HasSubstr("empty"));
}

TEST(TriangulateCloud, RefusesFewerThanTenPoints) {
    PointCloud cloud = spiral_sphere(0.05, 9);
    for (int i = 0; i < 20; ++i) cloud.points.push_back(cloud.points[i % 9]);
    for (int i = 0; i < 20; ++i) cloud.points.emplace_back(kNan, kNan, kNan);
    const PlanError error = error_of(cloud);
    EXPECT_EQ(error.code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(error.detail, HasSubstr("9 finite distinct points of 49"));
    EXPECT_TRUE(triangulate_cloud(spiral_sphere(0.05, 10), {}).ok());
}

TEST(TriangulateCloud, RefusesMoreThanItsLimit) {
    TriangulateCloudConfig config;
    config.limit_points = 99;
    const PlanError error = error_of(spiral_sphere(0.05, 100), config);
    EXPECT_EQ(error.code, PlanErrorCode::kTooLarge);
    EXPECT_THAT(error.detail, HasSubstr("100 points, limit limit_points = 99"));
}

TEST(TriangulateCloud, RefusesFlatClouds) {
    PointCloud plane, line;
    const Eigen::Isometry3d pose = test::random_pose(3);
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) plane.points.push_back(pose * Eigen::Vector3d(i, j, 0));
        line.points.push_back(pose * Eigen::Vector3d(i, 2.0 * i, 0));
    }
    for (const bool greedy : {false, true}) {
        TriangulateCloudConfig config;
        config.greedy_projection = greedy;
        EXPECT_EQ(error_of(plane, config).code, PlanErrorCode::kDegenerate);
        EXPECT_EQ(error_of(line, config).code, PlanErrorCode::kDegenerate);
    }
    EXPECT_THAT(error_of(plane).detail, HasSubstr("400 points is flat"));
}

// Greedy projection cuts off neighbours that are mu times farther than the nearest: pairs far apart
// from each other give no triangle at all.
TEST(TriangulateCloud, SaysWhenNoTriangleComesOut) {
    PointCloud cloud;
    for (const Eigen::Vector3d& point : spiral_sphere(0.5, 20).points) {
        cloud.points.push_back(point);
        cloud.points.push_back(point * 1.0001);
    }
    TriangulateCloudConfig config;
    config.greedy_projection = true;
    config.normal_neighbours = 3;
    const PlanError error = error_of(cloud, config);
    EXPECT_EQ(error.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error.detail, HasSubstr("no triangle came of the cloud's 40 points"));
}

TEST(TriangulateCloud, RefusesASettingOutOfRange) {
    TriangulateCloudConfig config;
    config.mu = 0.5;
    const PlanError error = error_of(spiral_sphere(0.05, 100), config);
    EXPECT_EQ(error.code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(error.detail, HasSubstr("triangulate_cloud.mu = 0.5"));
}

TEST(TriangulateCloud, RefusesCoordinatesTooLargeToMeasure) {
    PointCloud cloud = spiral_sphere(1e200, 100);
    EXPECT_EQ(error_of(cloud).code, PlanErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace graspd
