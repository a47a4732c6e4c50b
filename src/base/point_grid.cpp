#include "graspd/base/point_grid.hpp"

#include <algorithm>

namespace graspd {
namespace {

// Cells along an axis; a place outside the points' own cells is moved to the border, where there is
// a margin of empty ones.
constexpr std::int64_t kMargin = 2;
constexpr std::int64_t kCells = std::int64_t{1} << 21;
// Cells a point up to which each has a place in a table; the points of a surface, some to a cell,
// have fewer.
constexpr double kMostCells = 32.0;

}  // namespace

PointGrid::PointGrid(std::span<const Eigen::Vector3d> points, double cell_m) : cell_m_(cell_m) {
    if (points.empty()) return;
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& point : points) bounds.extend(point);
    origin_ = bounds.min();
    std::vector<Cell> cells;
    cells.reserve(points.size());
    for (const Eigen::Vector3d& point : points) cells.push_back(cell_of(point));
    points_.reserve(points.size());
    number_.reserve(points.size());
    const Cell last = cell_of(bounds.max());
    size_ = {last.x + 1, last.y + 1, last.z + 1};
    const double count =
        static_cast<double>(size_.x) * static_cast<double>(size_.y) * static_cast<double>(size_.z);
    if (count <= kMostCells * static_cast<double>(points.size()) + kMostCells) {
        sort_in(points, cells);
    } else {
        sort_by_key(points, cells);
    }
}

/// Counts the points of each cell, then puts each where its cell begins.
void PointGrid::sort_in(std::span<const Eigen::Vector3d> points, std::span<const Cell> cells) {
    const auto number = [&](const Cell& cell) {
        return static_cast<std::size_t>((cell.x * size_.y + cell.y) * size_.z + cell.z);
    };
    first_.assign(static_cast<std::size_t>(size_.x * size_.y * size_.z) + 1, 0);
    for (const Cell& cell : cells) ++first_[number(cell) + 1];
    for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    points_.resize(points.size());
    number_.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const std::uint32_t at = next[number(cells[i])]++;
        points_[at] = points[i];
        number_[at] = i;
    }
}

void PointGrid::sort_by_key(std::span<const Eigen::Vector3d> points, std::span<const Cell> cells) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) order.emplace_back(key(cells[i]), i);
    std::ranges::sort(order);
    keys_.reserve(points.size());
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

std::pair<std::size_t, std::size_t> PointGrid::searched_row(const Cell& from,
                                                            const Cell& to) const {
    const auto first = std::ranges::lower_bound(keys_, key(from));
    const auto last = std::upper_bound(first, keys_.end(), key(to));
    return {static_cast<std::size_t>(first - keys_.begin()),
            static_cast<std::size_t>(last - keys_.begin())};
}

}  // namespace graspd
