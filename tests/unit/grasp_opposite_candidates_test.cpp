#include "graspd/grasp/opposite_candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

SurfaceSample sample(const Vector3d& point, const Vector3d& normal) {
    return {point, normal, 1e-6, 0.0};
}

std::vector<OppositeCandidate> candidates(const TriangleMesh& mesh,
                                          const std::vector<SurfaceSample>& samples,
                                          double opening_m,
                                          const OppositeCandidatesConfig& config = {}) {
    const TriangleBvh tree(mesh, 1e-8);
    const auto result = opposite_candidates(samples, mesh, tree, opening_m, config);
    EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().detail);
    return result.ok() ? result.value() : std::vector<OppositeCandidate>{};
}

Vector3d normal_of(const TriangleMesh& mesh, std::uint32_t face) {
    const Triangle& t = mesh.faces[face];
    const Vector3d& a = mesh.vertices[t[0]];
    return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
}

// Of a block of 100 x 60 x 40 an opening of 85 spans y and z, not x.
TEST(OppositeCandidates, CrossTheBlockWhereItIsNarrowEnough) {
    const TriangleMesh mesh = test::box({0.10, 0.06, 0.04}, 200);
    const std::vector<SurfaceSample> samples = {sample({0.05, 0.003, 0.004}, {1, 0, 0}),
                                                sample({0.011, 0.03, 0.004}, {0, 1, 0}),
                                                sample({0.011, 0.007, -0.02}, {0, 0, -1})};
    const auto found = candidates(mesh, samples, 0.085);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].sample, 1U);
    EXPECT_LT((found[0].left_O - samples[1].point).norm(), 1e-12);
    EXPECT_LT((found[0].right_O - Vector3d(0.011, -0.03, 0.004)).norm(), 1e-9);
    EXPECT_NEAR(found[0].lean_rad, 0.0, 1e-7);
    EXPECT_LT((normal_of(mesh, found[0].right_face) - Vector3d(0, -1, 0)).norm(), 1e-9);
    EXPECT_EQ(found[1].sample, 2U);
    EXPECT_LT((found[1].right_O - Vector3d(0.011, 0.007, 0.02)).norm(), 1e-9);
    EXPECT_EQ(candidates(mesh, samples, 0.059).size(), 1U);
    EXPECT_EQ(candidates(mesh, samples, 0.101).size(), 3U);
}

// More samples than are served at a time.
TEST(OppositeCandidates, FollowTheOrderOfTheSamples) {
    const TriangleMesh mesh = test::box({0.10, 0.06, 0.04}, 200);
    std::vector<SurfaceSample> samples;
    for (int i = 0; i < 500; ++i) {
        // Every third looks along x, where the block is too long.
        const double at_m = 1e-5 * i - 0.0024;
        samples.push_back(i % 3 == 0 ? sample({0.05, at_m, 0.0}, {1, 0, 0})
                                     : sample({at_m, 0.03, 0.004}, {0, 1, 0}));
    }
    const auto found = candidates(mesh, samples, 0.085);
    ASSERT_EQ(found.size(), 333U);
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].sample, i / 2 * 3 + i % 2 + 1);
        EXPECT_NEAR(found[i].right_O.x(), samples[found[i].sample].point.x(), 1e-9);
    }
}

// From the inside of a cup's wall, radius 36, to its outside, 40: the line ends at the wall's other
// side although the cup goes on behind the cavity. Sides of the polygon lie inside the circles by
// less than 0.1.
TEST(OppositeCandidates, CrossAWall) {
    const TriangleMesh mesh = test::cup(0.04, 0.09, 0.004, 20000);
    std::vector<SurfaceSample> samples;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& t = mesh.faces[f];
        const Vector3d middle =
            (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
        const Vector3d normal = normal_of(mesh, f);
        if (std::abs(middle.z() - 0.05) < 0.01 && std::abs(normal.z()) < 1e-9) {
            samples.push_back(sample(middle, normal));
        }
    }
    ASSERT_GT(samples.size(), 100U);
    const auto found = candidates(mesh, samples, 0.085);
    ASSERT_EQ(found.size(), samples.size());
    for (const OppositeCandidate& candidate : found) {
        EXPECT_NEAR((candidate.right_O - candidate.left_O).norm(), 0.004, 1e-4);
        EXPECT_NEAR(candidate.left_O.head<2>().norm() + candidate.right_O.head<2>().norm(), 0.076,
                    2e-4);
    }
}

// Sides that lean by a each: straight in from one side the line leans by 2 a at the other. One turn
// halves the difference: a at both ends. It may not end on the bottom or top.
TEST(OppositeCandidates, ATurnSharesTheLeanOfAWedge) {
    const double a = 10.0 * kDegree;
    const double height_m = 0.06, rise_m = height_m * std::tan(a);
    const TriangleMesh mesh = test::wedge(0.03, 0.03 + 2.0 * rise_m, 0.05, height_m, 500);
    // The right side runs through (20.3, 0) in x and z; its normal leans down by a.
    const double x = 0.5 * (0.03 + rise_m);
    const std::vector<SurfaceSample> samples = {
        sample({x, 0.001, 0.0}, {std::cos(a), 0, -std::sin(a)})};
    const auto straight = candidates(mesh, samples, 0.085, {.turns = 0});
    ASSERT_EQ(straight.size(), 1U);
    EXPECT_NEAR(straight[0].lean_rad, 2.0 * a, 1e-7);
    const auto turned = candidates(mesh, samples, 0.085, {.turns = 1});
    ASSERT_EQ(turned.size(), 1U);
    EXPECT_NEAR(turned[0].lean_rad, a, 1e-7);
    EXPECT_LT((turned[0].right_O - Vector3d(-x, 0.001, 0.0)).norm(), 1e-7);  // level
    EXPECT_TRUE(candidates(mesh, samples, 0.085, {.max_lean_rad = a - 1e-4}).empty());
    EXPECT_EQ(candidates(mesh, samples, 0.085, {.max_lean_rad = a + 1e-4}).size(), 1U);
    EXPECT_TRUE(
        candidates(mesh, samples, 0.085, {.max_lean_rad = 2 * a - 1e-4, .turns = 0}).empty());
}

TEST(OppositeCandidates, WhatNoHandReachesIsLeftOut) {
    const TriangleMesh mesh = test::box({0.10, 0.06, 0.04}, 200);
    SurfaceSample enclosed = sample({0.011, 0.03, 0.004}, {0, 1, 0});
    enclosed.concavity_m = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(candidates(mesh, {enclosed}, 0.085).empty());
    // A sample off the surface, 2 outside: its line enters the solid first and leaves it later.
    EXPECT_TRUE(candidates(mesh, {sample({0.011, 0.032, 0.004}, {0, 1, 0})}, 0.085).empty());
    EXPECT_TRUE(candidates(mesh, {}, 0.085).empty());
}

TEST(OppositeCandidates, EveryErrorNamesItsCause) {
    const TriangleMesh mesh = test::box({0.10, 0.06, 0.04});
    const TriangleBvh tree(mesh, 1e-8);
    const std::vector<SurfaceSample> samples = {sample({0.05, 0, 0}, {1, 0, 0})};
    const auto expect = [&](double opening_m, const OppositeCandidatesConfig& config,
                            const char* name) {
        const auto result = opposite_candidates(samples, mesh, tree, opening_m, config);
        ASSERT_FALSE(result.ok()) << name;
        EXPECT_EQ(result.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_NE(result.error().detail.find(name), std::string::npos) << result.error().detail;
    };
    expect(0.0, {}, "opening_m");
    expect(kNaN, {}, "opening_m");
    expect(0.05, {.max_lean_rad = 0.0}, "max_lean_rad");
    expect(0.05, {.max_lean_rad = kNaN}, "max_lean_rad");
    expect(0.05, {.turns = 11}, "turns");
}

}  // namespace
}  // namespace graspd
