#include "graspd/contour/concave_hull.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::grid_points;
using test::is_inside;
using test::loop_area_m2;
using test::Points2;
using test::shuffled;

constexpr double kSpacing_m = 0.001;

Points2 filled_l() {
    return grid_points(40, kSpacing_m, [](int i, int j) { return i <= 15 || j <= 15; });
}

std::set<std::pair<double, double>> as_set(const Points2& points) {
    std::set<std::pair<double, double>> set;
    for (const auto& point : points) set.emplace(point.x(), point.y());
    return set;
}

// An L of 40 x 40 with a notch of 25 x 25. A disc of radius 3 rolls into the notch's corner until
// it touches both walls 3 beyond the corner, so at most the triangle of 3 * 3 / 2 behind it fills.
TEST(ConcaveHull, LKeepsItsNotch) {
    const auto hull = concave_hull(filled_l(), kSpacing_m, {});
    ASSERT_TRUE(hull.ok());
    const Points2& outline = hull.value().outline;
    const double area_in_cells = loop_area_m2(outline) / (kSpacing_m * kSpacing_m);
    EXPECT_GE(area_in_cells, 40 * 40 - 25 * 25 - 1e-6);
    EXPECT_LE(area_in_cells, 40 * 40 - 25 * 25 + 4.5 + 1e-6);
    EXPECT_FALSE(is_inside(outline, {0.0175, 0.0175}));
    EXPECT_TRUE(is_inside(outline, {0.0145, 0.0145}));
    EXPECT_TRUE(hull.value().other_loops.empty());
    EXPECT_EQ(outline.front(), Eigen::Vector2d(0, 0));
}

// A square of 40 with a square hole of 20 and, 20 away, a square of 10: the hole is cut from the
// outline's own loop, so the loops are 1600, about 400 (the hole, its corners rounded by the disc:
// 4 triangles of 4.5 at most), and 100.
TEST(ConcaveHull, HolesAndComponentsFollowByFallingArea) {
    auto points = grid_points(
        40, kSpacing_m, [](int i, int j) { return i <= 10 || j <= 10 || i >= 30 || j >= 30; });
    for (const auto& point : grid_points(10, kSpacing_m, [](int, int) { return true; })) {
        points.push_back(point + Eigen::Vector2d(0.06, 0.0));
    }
    const auto hull = concave_hull(points, kSpacing_m, {});
    ASSERT_TRUE(hull.ok());
    ASSERT_EQ(hull.value().other_loops.size(), 2U);
    const double cell_m2 = kSpacing_m * kSpacing_m;
    EXPECT_NEAR(loop_area_m2(hull.value().outline) / cell_m2, 1600, 1e-6);
    EXPECT_NEAR(loop_area_m2(hull.value().other_loops[0]) / cell_m2, 400 - 9, 9 + 1e-6);
    EXPECT_NEAR(loop_area_m2(hull.value().other_loops[1]) / cell_m2, 100, 1e-6);
}

// Turned, the points of a side lie in line but for rounding: exact predicates see triangles whose
// area is 0 in doubles. Their circles are as wide as the plane, not 0 / 0 (with CGAL's assertions
// on, as in the presets debug and fuzz, that ended the plan).
TEST(ConcaveHull, SidesInLineButForRounding) {
    const auto grid = grid_points(12, kSpacing_m, [](int, int j) { return j <= 8; });
    for (int step = 1; step < 100; ++step) {
        const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.0157 * step).toRotationMatrix();
        Points2 points;
        for (const auto& point : grid) points.push_back(turn * point);
        const auto hull = concave_hull(points, kSpacing_m, {});
        ASSERT_TRUE(hull.ok()) << step;
        EXPECT_NEAR(loop_area_m2(hull.value().outline) / (kSpacing_m * kSpacing_m), 96, 1e-6);
    }
}

// Two layers of one surface project on nearly the same points; a tenth of the spacing between them
// must change nothing: the first of each pair, in lexicographic order, is kept.
TEST(ConcaveHull, StackedLayersCountOnce) {
    Points2 points = filled_l();
    const std::size_t single = points.size();
    for (std::size_t i = 0; i < single; ++i) {
        points.push_back(points[i] + Eigen::Vector2d(1e-4, 1e-4));
    }
    const auto once = concave_hull(filled_l(), kSpacing_m, {});
    const auto twice = concave_hull(points, kSpacing_m, {});
    ASSERT_TRUE(once.ok());
    ASSERT_TRUE(twice.ok());
    EXPECT_EQ(once.value().outline, twice.value().outline);
}

// A band of 4 x 700: each of its points has another one to its right, less than a quarter of the
// spacing away in one of many directions, and none of these is kept, however far up it lies.
TEST(ConcaveHull, PointsTooNearAreDroppedAllAlongABand) {
    Points2 band, crowded;
    for (int i = 0; i <= 3; ++i) {
        for (int j = 0; j < 700; ++j) {
            band.push_back(kSpacing_m * Eigen::Vector2d(i, j));
            const double aside = 0.02 * ((37 * j + 11 * i) % 21 - 10);  // -0.2 to 0.2
            crowded.push_back(band.back());
            crowded.push_back(band.back() + kSpacing_m * Eigen::Vector2d(0.1, aside));
        }
    }
    const auto expected = concave_hull(band, kSpacing_m, {});
    const auto found = concave_hull(shuffled(crowded, 5), kSpacing_m, {});
    ASSERT_TRUE(expected.ok() && found.ok());
    EXPECT_EQ(expected.value().outline.size(), 2U * (3 + 699));
    EXPECT_EQ(found.value().outline, expected.value().outline);
}

// In floats a metre from the origin is told to 1e-7 m only; a square of 10 points at 0.1 mm, a
// kilometre away, still has its 36 border points, and they are the input's own.
TEST(ConcaveHull, FarFromTheOriginNoDigitIsLost) {
    auto points = grid_points(9, 1e-4, [](int, int) { return true; });
    for (auto& point : points) point += Eigen::Vector2d(1000.0, -1000.0);
    const auto hull = concave_hull(points, 1e-4, {});
    ASSERT_TRUE(hull.ok());
    EXPECT_EQ(hull.value().outline.size(), 36U);
    const auto input = as_set(points);
    for (const auto& point : hull.value().outline) {
        EXPECT_TRUE(input.contains({point.x(), point.y()}));
    }
}

// Random blobs: the loop is counter-clockwise, starts at its least point, uses points of the input
// once each, has no edge longer than 2 alpha (4.05 times the configured one at most), and
// the input's order changes no bit of it.
TEST(ConcaveHull, PropertiesHoldForRandomBlobsInAnyOrder) {
    for (std::uint32_t seed = 1; seed <= 25; ++seed) {
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> number(0.0, 0.04);
        Points2 points;
        while (points.size() < 1200) {
            const Eigen::Vector2d point(number(engine), number(engine));
            const bool is_notch = point.x() > 0.015 && point.x() < 0.025 && point.y() > 0.015;
            if (!is_notch) points.push_back(point);
        }
        const auto hull = concave_hull(points, kSpacing_m, {});
        ASSERT_TRUE(hull.ok()) << "seed " << seed << ": " << hull.error().detail;
        const Points2& outline = hull.value().outline;
        EXPECT_GT(loop_area_m2(outline), 0.0);
        EXPECT_EQ(as_set(outline).size(), outline.size());
        EXPECT_EQ(outline.front(), (Eigen::Vector2d(as_set(outline).begin()->first,
                                                    as_set(outline).begin()->second)));
        const auto input = as_set(points);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            EXPECT_TRUE(input.contains({outline[i].x(), outline[i].y()}));
            const double edge_m = (outline[(i + 1) % outline.size()] - outline[i]).norm();
            EXPECT_LE(edge_m, 2 * 3 * 4.05 * kSpacing_m);
        }
        EXPECT_FALSE(is_inside(outline, {0.02, 0.03})) << "the notch, seed " << seed;
        EXPECT_TRUE(is_inside(outline, {0.02, 0.01}));

        const auto again = concave_hull(shuffled(points, seed), kSpacing_m, {});
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(again.value().outline, outline);
        EXPECT_EQ(again.value().other_loops, hull.value().other_loops);
    }
}

// Two squares that share one corner point: the walk along the edges cannot pass it twice. Whatever
// alpha it takes, what comes back encloses both squares and has no false edge.
TEST(ConcaveHull, SquaresThatTouchInOnePointDoNotBreakTheWalk) {
    const auto points = grid_points(
        20, kSpacing_m, [](int i, int j) { return (i <= 10 && j <= 10) || (i >= 10 && j >= 10); });
    const auto hull = concave_hull(points, kSpacing_m, {.alpha_spacings = 1.0});
    ASSERT_TRUE(hull.ok());
    EXPECT_TRUE(is_inside(hull.value().outline, {0.0055, 0.0055}));
    EXPECT_TRUE(is_inside(hull.value().outline, {0.0155, 0.0155}));
    EXPECT_LT(loop_area_m2(hull.value().outline), 240e-6);
}

TEST(ConcaveHull, EveryErrorNamesItsCause) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto bad = filled_l();
    bad[3].y() = nan;
    const auto code = [](const Points2& points, double spacing_m, double alpha_spacings) {
        const auto hull = concave_hull(points, spacing_m, {.alpha_spacings = alpha_spacings});
        return hull.ok() ? PlanErrorCode::kInternal : hull.error().code;
    };
    EXPECT_EQ(code(bad, kSpacing_m, 3.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(filled_l(), 0.0, 3.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(filled_l(), nan, 3.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(filled_l(), kSpacing_m, 0.5), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code({}, kSpacing_m, 3.0), PlanErrorCode::kDegenerate);
    EXPECT_EQ(code({{0, 0}, {1, 0}, {0, 1}}, 1.0, 3.0), PlanErrorCode::kDegenerate);
    // Four points, but two of them closer than a quarter of the spacing.
    EXPECT_EQ(code({{0, 0}, {1, 0}, {0, 1}, {0.1, 0.1}}, 1.0, 3.0), PlanErrorCode::kDegenerate);
    // Collinear, neither along x nor along y.
    EXPECT_EQ(code({{0, 0}, {1, 2}, {2, 4}, {3, 6}, {4, 8}}, 1.0, 3.0), PlanErrorCode::kDegenerate);
    // The triangles of a unit square have a circumradius of 0.71; alpha is 0.3.
    EXPECT_EQ(code({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, 0.1, 3.0), PlanErrorCode::kDegenerate);
    const auto hull = concave_hull(bad, kSpacing_m, {});
    ASSERT_FALSE(hull.ok());
    EXPECT_NE(hull.error().detail.find("points[3]"), std::string::npos);
}

}  // namespace
}  // namespace graspd
