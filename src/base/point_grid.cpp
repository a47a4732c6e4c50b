#include "graspd/base/point_grid.hpp"

#include <algorithm>

namespace graspd {
namespace {

// Cells along an axis; a place outside the points' own cells is moved to the border, where there is
// a margin of empty ones.
constexpr std::int64_t kMargin = 2;
constexpr std::int64_t kCells = std::int64_t{1} << 21;

}  // namespace

PointGrid::PointGrid(std::span<const Eigen::Vector3d> points, double cell_m) : cell_m_(cell_m) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& point : points) bounds.extend(point);
    if (!points.empty()) origin_ = bounds.min();
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        order.emplace_back(key(cell_of(points[i])), i);
    std::ranges::sort(order);
    for (const auto& [cell, i] : order) {
        keys_.push_back(cell);
        points_.push_back(points[i]);
        number_.push_back(i);
    }
}

PointGrid::Cell PointGrid::cell_of(const Eigen::Vector3d& place) const {
    const auto along = [&](int axis) {
        const double cells = std::floor((place[axis] - origin_[axis]) / cell_m_);
        const double most = static_cast<double>(kCells - 2 * kMargin);
        return static_cast<std::int64_t>(std::clamp(cells, -1.0, most)) + kMargin;
    };
    return {along(0), along(1), along(2)};
}

std::uint64_t PointGrid::key(const Cell& cell) {
    return static_cast<std::uint64_t>((cell.x * kCells + cell.y) * kCells + cell.z);
}

std::pair<std::size_t, std::size_t> PointGrid::row(const Cell& from, const Cell& to) const {
    const auto first = std::ranges::lower_bound(keys_, key(from));
    const auto last = std::upper_bound(first, keys_.end(), key(to));
    return {static_cast<std::size_t>(first - keys_.begin()),
            static_cast<std::size_t>(last - keys_.begin())};
}

}  // namespace graspd
