#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Core>

namespace graspd::test {

using Points2 = std::vector<Eigen::Vector2d>;

/// Points on the grid of whole multiples of `spacing_m` from 0 to `cells` for which `inside` holds.
template <class Predicate>
Points2 grid_points(int cells, double spacing_m, Predicate inside) {
    Points2 points;
    for (int i = 0; i <= cells; ++i) {
        for (int j = 0; j <= cells; ++j) {
            if (inside(i, j)) points.emplace_back(i * spacing_m, j * spacing_m);
        }
    }
    return points;
}

/// The corners joined by points at equal distances of about `spacing_m`; a closed loop when the
/// first corner is repeated at the end, but without a repeated closing vertex.
inline Points2 sample_corners(const Points2& corners, double spacing_m) {
    Points2 points;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const Eigen::Vector2d edge = corners[i + 1] - corners[i];
        const auto parts = std::max(1L, std::lround(edge.norm() / spacing_m));
        for (long k = 0; k < parts; ++k) {
            points.push_back(corners[i] +
                             (static_cast<double>(k) / static_cast<double>(parts)) * edge);
        }
    }
    if (corners.front() != corners.back()) points.push_back(corners.back());
    return points;
}

/// `count` points on a circle, counter-clockwise from angle 0.
inline Points2 circle_points(const Eigen::Vector2d& center, double radius_m, int count) {
    Points2 points;
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        points.push_back(center + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return points;
}

/// The same points in an order of the seed's choice.
inline Points2 shuffled(Points2 points, std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::ranges::shuffle(points, engine);
    return points;
}

/// Area of a closed loop [m^2], positive when counter-clockwise.
inline double loop_area_m2(const Points2& loop) {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d& a = loop[i];
        const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
}

/// Whether a point lies inside a closed loop (even-odd rule).
inline bool is_inside(const Points2& loop, const Eigen::Vector2d& point) {
    bool inside = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d& a = loop[i];
        const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
        if ((a.y() > point.y()) == (b.y() > point.y())) continue;
        const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        if (point.x() < x) inside = !inside;
    }
    return inside;
}

}  // namespace graspd::test
