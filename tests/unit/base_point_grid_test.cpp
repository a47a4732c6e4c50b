#include "graspd/base/point_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace graspd {
namespace {

using Eigen::Vector3d;

std::vector<std::uint32_t> within(const PointGrid& grid, const Vector3d& place, double distance_m) {
    std::vector<std::uint32_t> found;
    EXPECT_TRUE(grid.each_within(place, distance_m, [&](std::uint32_t i) {
        found.push_back(i);
        return true;
    }));
    std::ranges::sort(found);
    return found;
}

// Random points, near the origin and a kilometre off; places among them and outside their bounds.
TEST(PointGrid, FindsWhatComparingAllFinds) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> number(-0.05, 0.05);
    for (const double offset_m : {0.0, 1000.0}) {
        std::vector<Vector3d> points(500);
        for (Vector3d& p : points) {
            p = Vector3d(number(engine), number(engine), number(engine));
            p += Vector3d(offset_m, -offset_m, 0.0);
        }
        const PointGrid grid(points, 0.02);
        for (int k = 0; k < 200; ++k) {
            const Vector3d place = points[static_cast<std::size_t>(k)] +
                                   2.0 * Vector3d(number(engine), number(engine), number(engine));
            const double distance_m = 0.005 + 0.015 * (k % 4) / 3.0;
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                if ((points[i] - place).norm() <= distance_m) expected.push_back(i);
            }
            EXPECT_EQ(within(grid, place, distance_m), expected);
        }
    }
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The lower number of a pair first, pairs in rising order.
Pairs pairs_within(const PointGrid& grid, double distance_m) {
    Pairs found;
    grid.each_pair_within(distance_m, [&](std::uint32_t i, std::uint32_t j) {
        found.emplace_back(std::min(i, j), std::max(i, j));
    });
    std::ranges::sort(found);
    return found;
}

// Near the origin, and in two clouds far apart, whose cells have no table: every pair, once.
TEST(PointGrid, MeetsEveryPairOnce) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> number(-0.05, 0.05);
    for (const double apart_m : {0.0, 900.0}) {
        std::vector<Vector3d> points;
        for (int k = 0; k < 400; ++k) {
            const Vector3d shift = k % 2 == 0 ? Vector3d::Zero() : Vector3d(apart_m, -apart_m, 1.0);
            points.push_back(shift + Vector3d(number(engine), number(engine), number(engine)));
        }
        points.push_back(points.front());  // and two at one place
        const PointGrid grid(points, 0.02);
        for (const double distance_m : {0.02, 0.011}) {
            Pairs expected;
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                for (std::uint32_t j = i + 1; j < points.size(); ++j) {
                    if ((points[i] - points[j]).norm() <= distance_m) expected.emplace_back(i, j);
                }
            }
            EXPECT_GT(expected.size(), 100U);
            EXPECT_EQ(pairs_within(grid, distance_m), expected);
        }
    }
}

// Two clouds a kilometre apart have far too many cells between them for a table of all.
TEST(PointGrid, PointsFarApartAreFoundToo) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> number(-0.05, 0.05);
    std::vector<Vector3d> points;
    for (int k = 0; k < 300; ++k) {
        const Vector3d shift = k % 2 == 0 ? Vector3d::Zero() : Vector3d(900.0, -400.0, 100.0);
        points.push_back(shift + Vector3d(number(engine), number(engine), number(engine)));
    }
    const PointGrid grid(points, 0.02);
    for (const Vector3d& place : points) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if ((points[i] - place).norm() <= 0.02) expected.push_back(i);
        }
        EXPECT_EQ(within(grid, place, 0.02), expected);
    }
}

TEST(PointGrid, EndsWhenItIsToldTo) {
    const std::vector<Vector3d> points(10, Vector3d::Zero());
    const PointGrid grid(points, 0.01);
    int asked = 0;
    EXPECT_FALSE(
        grid.each_within(Vector3d::Zero(), 0.01, [&](std::uint32_t) { return ++asked < 3; }));
    EXPECT_EQ(asked, 3);
}

TEST(PointGrid, WithoutPointsNobodyIsNear) {
    const PointGrid grid({}, 0.01);
    EXPECT_TRUE(within(grid, Vector3d::Zero(), 0.01).empty());
    EXPECT_TRUE(pairs_within(grid, 0.01).empty());
}

}  // namespace
}  // namespace graspd
