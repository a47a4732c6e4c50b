#include "graspd/grasp/circle_cut.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::Points2;

constexpr double kNoGap_m = std::numeric_limits<double>::infinity();

// The line y = 3 meets the circle of radius 5 about the origin at x = -4 and x = 4 (3-4-5).
TEST(CircleCut, ThreeFourFive) {
    const Points2 line = {{-10, 3}, {0, 3}, {10, 3}};
    const auto first = first_circle_cut(line, {0, 0}, 5.0, 0, kNoGap_m);
    ASSERT_TRUE(first.has_value());
    EXPECT_NEAR((first->point - Eigen::Vector2d(-4, 3)).norm(), 0.0, 1e-14);
    EXPECT_EQ(first->segment, 0U);
    const auto second = first_circle_cut(line, {0, 0}, 5.0, 1, kNoGap_m);
    ASSERT_TRUE(second.has_value());
    EXPECT_NEAR((second->point - Eigen::Vector2d(4, 3)).norm(), 0.0, 1e-14);
    EXPECT_EQ(second->segment, 1U);
    EXPECT_EQ(all_circle_cuts(line, {0, 0}, 5.0, 0, kNoGap_m).size(), 2U);
}

// Outwards from the centre itself: on a ray the cut lies r away, whatever the segment's length.
TEST(CircleCut, FromTheCentreOutwards) {
    for (const double length : {1.0, 1.5, 1e3, 1e9}) {
        const Points2 ray = {{0, 0}, {0.6 * length, 0.8 * length}};
        const auto cut = first_circle_cut(ray, {0, 0}, 1.0, 0, kNoGap_m);
        ASSERT_TRUE(cut.has_value()) << length;
        EXPECT_NEAR((cut->point - Eigen::Vector2d(0.6, 0.8)).norm(), 0.0, 1e-12) << length;
    }
}

// Eq. (2) compares the end points only, so a segment that dips into the circle is not seen.
TEST(CircleCut, AChordBetweenOutsidePointsIsNotSeen) {
    const Points2 line = {{-10, 3}, {10, 3}};
    EXPECT_FALSE(first_circle_cut(line, {0, 0}, 5.0, 0, kNoGap_m).has_value());
}

// The vertex (5, 0) lies on the circle and belongs to two segments: one cut, on the first of them.
TEST(CircleCut, AVertexOnTheCircleCountsOnce) {
    const Points2 line = {{0, 0}, {5, 0}, {9, 0}};
    const auto cuts = all_circle_cuts(line, {0, 0}, 5.0, 0, kNoGap_m);
    ASSERT_EQ(cuts.size(), 1U);
    EXPECT_EQ(cuts[0].point, Eigen::Vector2d(5, 0));
    EXPECT_EQ(cuts[0].segment, 0U);
}

// The segment from (2, 0) to (8, 0) is 6 long: a jump when gaps end at 5, boundary when at 7.
TEST(CircleCut, AJumpIsNoBoundary) {
    const Points2 line = {{0, 0}, {2, 0}, {8, 0}, {8, 1}};
    EXPECT_FALSE(first_circle_cut(line, {0, 0}, 5.0, 0, 5.0).has_value());
    const auto cut = first_circle_cut(line, {0, 0}, 5.0, 0, 7.0);
    ASSERT_TRUE(cut.has_value());
    EXPECT_NEAR((cut->point - Eigen::Vector2d(5, 0)).norm(), 0.0, 1e-14);
}

TEST(CircleCut, NoPolylineNoCut) {
    EXPECT_FALSE(first_circle_cut({}, {0, 0}, 1.0, 0, kNoGap_m).has_value());
    EXPECT_FALSE(first_circle_cut(Points2{{1, 0}}, {0, 0}, 1.0, 0, kNoGap_m).has_value());
    EXPECT_FALSE(first_circle_cut(Points2{{0, 0}, {2, 0}}, {0, 0}, 1.0, 1, kNoGap_m).has_value());
    EXPECT_TRUE(all_circle_cuts({}, {0, 0}, 1.0, 0, kNoGap_m).empty());
}

// Random walks: each cut lies r from the centre and on its segment, rising; between two cuts the
// points stay on one side of the circle, so there are as many cuts as changes of side.
TEST(CircleCut, CutsLieOnTheCircleAndOnTheirSegments) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        std::mt19937 engine(seed);
        std::normal_distribution<double> step(0.0, 0.4);
        Points2 walk = {{0.3, 0.1}};
        for (int k = 0; k < 300; ++k) {
            walk.push_back(walk.back() + Eigen::Vector2d(step(engine), step(engine)));
        }
        std::size_t changes = 0;
        for (std::size_t n = 0; n + 1 < walk.size(); ++n) {
            if ((walk[n].norm() < 2.0) != (walk[n + 1].norm() < 2.0)) ++changes;
        }
        const auto cuts = all_circle_cuts(walk, {0, 0}, 2.0, 0, kNoGap_m);
        EXPECT_EQ(cuts.size(), changes);
        for (const auto& cut : cuts) {
            EXPECT_NEAR(cut.point.norm(), 2.0, 1e-12);
            const Eigen::Vector2d& a = walk[cut.segment];
            const Eigen::Vector2d& b = walk[cut.segment + 1];
            EXPECT_NEAR((cut.point - a).norm() + (b - cut.point).norm(), (b - a).norm(), 1e-12);
        }
    }
}

}  // namespace
}  // namespace graspd
