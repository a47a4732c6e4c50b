#include "graspd/contour/boundary_points.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::Points2;
using test::sample_corners;

Points2 rectangle(double half_x_m, double half_y_m, double spacing_m) {
    return sample_corners({{-half_x_m, -half_y_m},
                           {half_x_m, -half_y_m},
                           {half_x_m, half_y_m},
                           {-half_x_m, half_y_m},
                           {-half_x_m, -half_y_m}},
                          spacing_m);
}

// A band across a taller rectangle of the same width: its left and right edges lie on the object's
// boundary, its top and bottom run through the inside. Points stand 2 mm apart, d_threshold is 1
// mm.
TEST(BoundaryPoints, BandKeepsItsLeftAndRightEdgesOnly) {
    const auto band = rectangle(0.02, 0.01, 0.002);
    const auto object = rectangle(0.02, 0.04, 0.002);
    const auto boundary = boundary_points(band, object, 0.001, {});
    ASSERT_TRUE(boundary.ok());
    Points2 expected;
    for (const auto& point : band) {
        if (std::abs(std::abs(point.x()) - 0.02) < 1e-12) expected.push_back(point);
    }
    EXPECT_EQ(expected.size(), 22U);  // 11 points on each edge of 20 mm
    EXPECT_EQ(boundary.value(), expected);
}

// Eq. (1) asks for the foot to lie on the segment. The point (10, 20) lies exactly on the line of
// the L's inner edge from (40, 20) to (20, 20), at t = 1.5; the nearest foot is 10 away. The
// point (16, 18) is 4.5 from the corner and 2 and 4 from the lines through it, at t = 1.2 and t =
// -0.1.
TEST(BoundaryPoints, AFootBeyondTheSegmentDoesNotCount) {
    const Points2 l_shape = {{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}};
    const Points2 cluster = {{10, 20}, {16, 18}, {30, 20}, {20, 30}};
    const auto boundary = boundary_points(cluster, l_shape, 1.0, {.d_threshold_spacings = 5.0});
    ASSERT_TRUE(boundary.ok());
    EXPECT_EQ(boundary.value(), (Points2{{30, 20}, {20, 30}}));
}

// So far from its edge's start that only the threshold lets the edge reach it: its foot is the
// edge's end, and the next edge has none.
TEST(BoundaryPoints, AFootAtASegmentsEndCounts) {
    const Points2 square = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    const auto boundary =
        boundary_points(Points2{{8, -0.9}, {8, -1.1}, {8.5, -0.9}}, square, 1.0, {});
    ASSERT_TRUE(boundary.ok());
    EXPECT_EQ(boundary.value(), (Points2{{8, -0.9}}));
}

// The threshold itself is outside: "below d_threshold". 0.5 and 0.25 are exact in binary.
TEST(BoundaryPoints, TheThresholdIsExclusive) {
    const Points2 square = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    const Points2 cluster = {{4, 0.5}, {4, 0.25}, {4, 4}};
    const auto boundary = boundary_points(cluster, square, 0.5, {});
    ASSERT_TRUE(boundary.ok());
    EXPECT_EQ(boundary.value(), (Points2{{4, 0.25}}));
}

// The segment from the last point back to the first belongs to a closed loop.
TEST(BoundaryPoints, TheClosingSegmentCounts) {
    const Points2 square = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    const auto boundary = boundary_points(Points2{{0, 4}, {3, 4}, {4, 3}}, square, 1.0, {});
    ASSERT_TRUE(boundary.ok());
    EXPECT_EQ(boundary.value(), (Points2{{0, 4}}));
}

// A dent in the middle of a plate touches no boundary: that is an answer, not an error.
TEST(BoundaryPoints, AnOutlineInsideHasNone) {
    const auto boundary =
        boundary_points(rectangle(0.01, 0.01, 0.001), rectangle(0.04, 0.04, 0.001), 0.001, {});
    ASSERT_TRUE(boundary.ok());
    EXPECT_TRUE(boundary.value().empty());
}

// Every point of a loop lies on that loop, and turning the plane changes nothing.
TEST(BoundaryPoints, EveryPointOfTheLoopItselfIsBoundary) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> radius(0.02, 0.05);
        Points2 loop = test::circle_points({0.3, -0.2}, 1.0, 60);
        for (auto& point : loop) {
            point =
                Eigen::Vector2d(0.3, -0.2) + radius(engine) * (point - Eigen::Vector2d(0.3, -0.2));
        }
        const auto boundary = boundary_points(loop, loop, 0.001, {});
        ASSERT_TRUE(boundary.ok());
        EXPECT_EQ(boundary.value(), loop);
    }
}

TEST(BoundaryPoints, EveryErrorNamesItsCause) {
    const Points2 square = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};
    Points2 bad = square;
    bad[2].x() = std::numeric_limits<double>::infinity();
    const auto code = [](const Points2& cluster, const Points2& enlarged, double spacing_m,
                         double d_threshold_spacings) {
        const auto boundary = boundary_points(cluster, enlarged, spacing_m,
                                              {.d_threshold_spacings = d_threshold_spacings});
        return boundary.ok() ? PlanErrorCode::kInternal : boundary.error().code;
    };
    EXPECT_EQ(code(bad, square, 1.0, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(square, bad, 1.0, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(square, square, -1.0, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(square, square, 1.0, 0.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code({{0, 0}, {1, 1}}, square, 1.0, 1.0), PlanErrorCode::kDegenerate);
    EXPECT_EQ(code(square, {}, 1.0, 1.0), PlanErrorCode::kDegenerate);
    const auto boundary = boundary_points(square, bad, 1.0, {});
    ASSERT_FALSE(boundary.ok());
    EXPECT_NE(boundary.error().detail.find("enlarged_outline[2]"), std::string::npos);
}

}  // namespace
}  // namespace graspd
