#include "graspd/contour/order_boundary.hpp"

#include <gtest/gtest.h>

#include "graspd/base/plane_points.hpp"
#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::Points2;
using test::shuffled;

// Points on a line are ordered along it.
TEST(OrderBoundary, ALineRunsFromItsLeftEnd) {
    Points2 line;
    for (int k = 0; k < 40; ++k) line.emplace_back(0.001 * k, 0.002 * k);
    EXPECT_EQ(order_boundary(shuffled(line, 3)), line);
}

// On a circle the row starts at the leftmost point; its two neighbours are equally far up to
// rounding, and from the second point on the way round is forced.
TEST(OrderBoundary, ACircleIsWalkedAround) {
    const int count = 100;
    const auto circle = test::circle_points({0.5, 0.5}, 0.05, count);
    const auto row = order_boundary(shuffled(circle, 11));
    ASSERT_EQ(row.size(), circle.size());
    EXPECT_NEAR(row.front().x(), 0.45, 1e-12);
    const double side_m = 2 * 0.05 * std::sin(std::numbers::pi / count);
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        EXPECT_NEAR((row[i + 1] - row[i]).norm(), side_m, 1e-12) << i;
    }
}

// Ties: the start is the lower of two leftmost points; of four points equally near to the second
// one the lexicographically least comes next.
TEST(OrderBoundary, TiesAreResolvedLexicographically) {
    const Points2 cross = {{3, 0}, {2, 1}, {1, 0}, {2, -1}, {2, 0}, {1, 4}};
    const Points2 expected = {{1, 0}, {2, 0}, {2, -1}, {3, 0}, {2, 1}, {1, 4}};
    EXPECT_EQ(order_boundary(cross), expected);
}

// By definition: the first is the least of all, each next one at least as near as any later one;
// the same points, in a row that their first order does not touch.
TEST(OrderBoundary, EveryNextPointIsTheNearestUnusedOne) {
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        std::mt19937 engine(seed);
        std::uniform_int_distribution<int> cell(0, 12);  // many ties, some duplicates
        Points2 points;
        for (int k = 0; k < 80; ++k) points.emplace_back(cell(engine), cell(engine));
        const auto row = order_boundary(points);
        EXPECT_EQ(order_boundary(shuffled(points, seed)), row);
        for (std::size_t i = 1; i < row.size(); ++i) {
            EXPECT_FALSE(lexicographic_less(row[i], row[0]));
            const double step = (row[i] - row[i - 1]).squaredNorm();
            for (std::size_t k = i + 1; k < row.size(); ++k) {
                const double other = (row[k] - row[i - 1]).squaredNorm();
                EXPECT_TRUE(step < other || (step == other && !lexicographic_less(row[k], row[i])));
            }
        }
        auto sorted_row = row;
        std::ranges::sort(sorted_row, lexicographic_less);
        std::ranges::sort(points, lexicographic_less);
        EXPECT_EQ(sorted_row, points);
    }
}

TEST(OrderBoundary, NoneAndOneAreRows) {
    EXPECT_TRUE(order_boundary({}).empty());
    EXPECT_EQ(order_boundary({{1, 2}}), (Points2{{1, 2}}));
}

}  // namespace
}  // namespace graspd
