#include "graspd/grasp/grasp_sides.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "graspd/base/plane_points.hpp"
#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::Points2;
using test::shuffled;

/// A row of points every half unit, 21 values of y from -10 to 10, x from left(y) to right(y).
template <class Left, class Right>
Points2 filled_between(Left left, Right right) {
    Points2 points;
    for (int j = -10; j <= 10; ++j) {
        const double y = j;
        for (int i = 0; i <= 20; ++i) {
            points.emplace_back(left(y) + (right(y) - left(y)) * i / 20.0, y);
        }
    }
    return points;
}

// A rectangle is seen as its two vertical edges, every one of its 21 rows.
TEST(GraspSides, ARectangleShowsItsEdges) {
    const auto points = filled_between([](double) { return -30.0; }, [](double) { return 30.0; });
    const auto sides = grasp_sides(points, 1.0, {.max_depth_m = 0.5});
    ASSERT_TRUE(sides.ok());
    ASSERT_EQ(sides.value().left_G.size(), 21U);
    ASSERT_EQ(sides.value().right_G.size(), 21U);
    for (std::size_t k = 0; k < 21; ++k) {
        const double y = static_cast<double>(k) - 10.0;
        EXPECT_EQ(sides.value().left_G[k], Eigen::Vector2d(-30, y));
        EXPECT_EQ(sides.value().right_G[k], Eigen::Vector2d(30, y));
    }
}

// Sides that lean by 45 degrees as a parallelogram. Coming from -x the pad first touches the row y
// = -10 at x = -40 and reaches 0.4 deep: the rows -10 .. -6 ... x = -30 + y, so depth <= 0.4 holds
// for y <= -9.6: one row with unit steps; with depth 1 exactly two, with 0.0041 * 1000 = 4.1 five.
TEST(GraspSides, ALeaningSideIsFeltOnlyToItsDepth) {
    const auto points =
        filled_between([](double y) { return -30.0 + y; }, [](double y) { return 30.0 + y; });
    auto metres = points;
    for (auto& point : metres) point *= 0.001;
    const auto sides = grasp_sides(metres, 0.001, {.max_depth_m = 0.0041});
    ASSERT_TRUE(sides.ok());
    ASSERT_EQ(sides.value().left_G.size(), 5U);
    ASSERT_EQ(sides.value().right_G.size(), 5U);
    EXPECT_NEAR(sides.value().left_G.front().y(), -0.010, 1e-15);
    EXPECT_NEAR(sides.value().left_G.back().y(), -0.006, 1e-15);
    EXPECT_NEAR(sides.value().right_G.front().y(), 0.006, 1e-15);
    EXPECT_NEAR(sides.value().right_G.back().y(), 0.010, 1e-15);
}

// A groove of 5 in the left side is seen, being what the pad meets in those rows, but not felt when
// the pad reaches 4 only.
TEST(GraspSides, AGrooveIsNotTouched) {
    const auto points = filled_between([](double y) { return std::abs(y) <= 3.0 ? -25.0 : -30.0; },
                                       [](double) { return 30.0; });
    const auto deep = grasp_sides(points, 1.0, {.max_depth_m = 1.0});
    ASSERT_TRUE(deep.ok());
    EXPECT_EQ(deep.value().left_G.size(), 21U - 7U);
    EXPECT_EQ(deep.value().right_G.size(), 21U);
    for (const auto& point : deep.value().left_G) EXPECT_GT(std::abs(point.y()), 3.0);
}

// Random clouds: every side point is a point of the cloud, no point of its bin stands further out,
// none is deeper than allowed, and the order of the cloud changes nothing.
TEST(GraspSides, NothingStandsFurtherOut) {
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> number(-0.01, 0.01);
        Points2 points;
        for (int k = 0; k < 3000; ++k) points.emplace_back(3.0 * number(engine), number(engine));
        const GraspSidesConfig config{.bin_spacings = 2.0, .min_points = 3, .max_depth_m = 0.003};
        const auto sides = grasp_sides(points, 0.0005, config);
        ASSERT_TRUE(sides.ok());
        const double left_touch = std::ranges::min_element(points, lexicographic_less)->x();
        for (const auto& side_point : sides.value().left_G) {
            EXPECT_LE(side_point.x() - left_touch, 0.003);
            EXPECT_NE(std::ranges::find(points, side_point), points.end());
            for (const auto& point : points) {
                const bool same_bin =
                    std::floor(point.y() / 0.001) == std::floor(side_point.y() / 0.001);
                EXPECT_FALSE(same_bin && point.x() < side_point.x());
            }
        }
        for (const auto& side_point : sides.value().right_G) {
            for (const auto& point : points) {
                const bool same_bin =
                    std::floor(point.y() / 0.001) == std::floor(side_point.y() / 0.001);
                EXPECT_FALSE(same_bin && point.x() > side_point.x());
            }
        }
        const auto again = grasp_sides(shuffled(points, seed), 0.0005, config);
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(again.value().left_G, sides.value().left_G);
        EXPECT_EQ(again.value().right_G, sides.value().right_G);
    }
}

TEST(GraspSides, EveryErrorNamesItsCause) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto points = filled_between([](double) { return -30.0; }, [](double) { return 30.0; });
    const auto code = [](const Points2& local_G, double spacing_m, const GraspSidesConfig& config) {
        const auto sides = grasp_sides(local_G, spacing_m, config);
        return sides.ok() ? PlanErrorCode::kInternal : sides.error().code;
    };
    EXPECT_EQ(code({{0, nan}}, 1.0, {}), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(points, 0.0, {}), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(points, 1.0, {.bin_spacings = 0.0}), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(points, 1.0, {.min_points = 1}), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(points, 1.0, {.max_depth_m = nan}), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code({}, 1.0, {}), PlanErrorCode::kDegenerate);
    EXPECT_EQ(code(points, 1.0, {.min_points = 22}), PlanErrorCode::kDegenerate);
    // The left side alone is too short: a spike in one row stands 5 out.
    const auto spike = filled_between([](double y) { return y == 0.0 ? -35.0 : -30.0; },
                                      [](double) { return 30.0; });
    const auto sides = grasp_sides(spike, 1.0, {.max_depth_m = 1.0});
    ASSERT_FALSE(sides.ok());
    EXPECT_EQ(sides.error().code, PlanErrorCode::kDegenerate);
    EXPECT_NE(sides.error().detail.find("left_G has 1"), std::string::npos);
}

}  // namespace
}  // namespace graspd
