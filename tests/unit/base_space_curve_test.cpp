#include "graspd/base/space_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace graspd {
namespace {

std::vector<std::uint32_t> numbers(const std::vector<Eigen::Array4f>& points) {
    std::vector<std::uint32_t> order;
    for (const CurvePlace& place : order_on_curve(points)) order.push_back(place.number);
    return order;
}

// The corners of a cube, numbered by x + 2 y + 4 z. The curve runs along z last, then y, then x:
// the first axis is the highest bit.
TEST(OrderOnCurve, VisitsAnOctantAtATime) {
    std::vector<Eigen::Array4f> points;
    for (int i = 0; i < 8; ++i) {
        points.emplace_back(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                            static_cast<float>(i >> 2), 0.0F);
    }
    EXPECT_EQ(numbers(points), (std::vector<std::uint32_t>{0, 4, 2, 6, 1, 5, 3, 7}));
    EXPECT_EQ(order_on_curve(points).front().code, 0u);
    EXPECT_EQ(order_on_curve(points).back().code, (1u << CurvePlace::kBits) - 1);
}

// 1000 points in a row: in their order along x, whatever order they come in.
TEST(OrderOnCurve, FollowsALine) {
    std::vector<Eigen::Array4f> points;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        points.emplace_back(static_cast<float>(i * 7 % 1000), 0.0F, 0.0F, 0.0F);
    }
    const std::vector<std::uint32_t> order = numbers(points);
    for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(order[i] * 7 % 1000, i);
}

// A double's place may be beyond what a float holds.
TEST(OrderOnCurve, WhatIsInfinitelyFarHasAPlaceToo) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const std::vector<std::uint32_t> order =
        numbers({{0, 0, 0, 0}, {kFar, 1, 0, 0}, {-kFar, 2, kFar, 0}, {3, 3, 3, 0}});
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2, 3}));  // no scale: as they came
}

TEST(OrderOnCurve, KeepsTheOrderOfEqualPoints) {
    const std::vector<Eigen::Array4f> points(5, Eigen::Array4f(1, 2, 3, 0));
    EXPECT_EQ(numbers(points), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    EXPECT_TRUE(order_on_curve({}).empty());
}

}  // namespace
}  // namespace graspd
