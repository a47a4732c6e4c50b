#include "drop_outliers.hpp"

#include <algorithm>

#include "graspd/base/disjoint_sets.hpp"
#include "graspd/base/point_grid.hpp"

namespace graspd::mesh_detail {
namespace {

// [1] Of the reach: most of a surface hangs together over shorter steps, which are found faster.
constexpr double kShortStep = 1.0 / 3.0;

void unite_near(const std::vector<Eigen::Vector3d>& points, const PointGrid& grid, double reach_m,
                std::uint32_t i, DisjointSets& groups) {
    grid.each_within(points[i], reach_m, [&](std::uint32_t other) {
        groups.unite(i, other);
        return true;
    });
}

/// How many points each group has, at the place of its name.
std::vector<std::size_t> sizes_of(DisjointSets& groups, std::size_t points) {
    std::vector<std::size_t> size(points, 0);
    for (std::uint32_t i = 0; i < points; ++i) ++size[groups.find(i)];
    return size;
}

/// Groups joined by steps of at most reach_m. A step between two points of one group joins nothing,
/// so that the long ones are looked for from outside the largest group alone.
DisjointSets group_points(const std::vector<Eigen::Vector3d>& points, double reach_m) {
    DisjointSets groups(points.size());
    const PointGrid fine(points, kShortStep * reach_m);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        unite_near(points, fine, kShortStep * reach_m, i, groups);
    }
    const std::vector<std::size_t> size = sizes_of(groups, points.size());
    if (std::ranges::max(size) == points.size()) return groups;
    const auto largest = static_cast<std::uint32_t>(std::ranges::max_element(size) - size.begin());
    std::vector<std::uint32_t> outside;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (groups.find(i) != largest) outside.push_back(i);
    }
    const PointGrid coarse(points, reach_m);
    for (const std::uint32_t i : outside) unite_near(points, coarse, reach_m, i, groups);
    return groups;
}

}  // namespace

Outliers find_outliers(const std::vector<Eigen::Vector3d>& points, double reach_m,
                       std::size_t least_group) {
    Outliers outliers{std::vector<char>(points.size(), 1), 0};
    DisjointSets groups = group_points(points, reach_m);
    const std::vector<std::size_t> size = sizes_of(groups, points.size());
    const std::size_t largest = std::ranges::max(size);
    if (2 * largest < points.size()) return outliers;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        outliers.keep[i] = size[groups.find(i)] >= std::min(least_group, largest);
        outliers.count += !outliers.keep[i];
    }
    return outliers;
}

}  // namespace graspd::mesh_detail
