#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/stop.hpp"

namespace graspd {

/// Points in cubic cells, for questions of the form "who is within a cell's length of here".
/// Immutable after construction, so safe to query from any thread.
class PointGrid {
public:
    /// @param points  [m] finite; copied
    /// @param cell_m  [m] > 0, no less than the largest distance that will be asked for and than a
    ///                millionth of the points' extent
    /// Cost O(N), or O(N log N) where there are far more cells than points.
    PointGrid(std::span<const Eigen::Vector3d> points, double cell_m);

    /// Calls visit(i) for every point i within `distance_m` <= cell_m of a place, until it returns
    /// false. @return whether no visit returned false
    template <class Visit>
    bool each_within(const Eigen::Vector3d& place, double distance_m, Visit&& visit) const {
        const double squared = distance_m * distance_m;
        const Cell center = cell_of(place);
        for (std::int64_t x = center.x - 1; x <= center.x + 1; ++x) {
            for (std::int64_t y = center.y - 1; y <= center.y + 1; ++y) {
                const auto [first, last] = row({x, y, center.z - 1}, {x, y, center.z + 1});
                for (std::size_t at = first; at < last; ++at) {
                    if ((points_[at] - place).squaredNorm() > squared) continue;
                    if (!visit(number_[at])) return false;
                }
            }
        }
        return true;
    }

    /// Calls visit(i, j) once for any two points within `distance_m` <= cell_m of each other, in an
    /// order of its own. Stoppable.
    template <class Visit>
    void each_pair_within(double distance_m, Visit&& visit) const {
        const double squared = distance_m * distance_m;
        for (std::size_t at = 0; at < points_.size(); ++at) {
            stop_point(at);
            const auto meet = [&](std::size_t first, std::size_t last) {
                for (std::size_t other = first; other < last; ++other) {
                    if ((points_[other] - points_[at]).squaredNorm() > squared) continue;
                    visit(number_[at], number_[other]);
                }
            };
            // Who comes before in the order of the cells has met this point already.
            const auto [x, y, z] = cell_of(points_[at]);
            meet(at + 1, row({x, y, z - 1}, {x, y, z + 1}).second);
            for (const auto& [i, j] :
                 {std::pair{x, y + 1}, {x + 1, y - 1}, {x + 1, y}, {x + 1, y + 1}}) {
                const auto [first, last] = row({i, j, z - 1}, {i, j, z + 1});
                meet(first, last);
            }
        }
    }

private:
    struct Cell {
        std::int64_t x = 0, y = 0, z = 0;
    };
    Cell cell_of(const Eigen::Vector3d& place) const;
    /// One number a cell; cells that follow each other along z have numbers that do.
    static std::uint64_t key(const Cell& cell);
    /// Places of the points whose cells lie between two of one row.
    std::pair<std::size_t, std::size_t> row(const Cell& from, const Cell& to) const {
        if (first_.empty()) return searched_row(from, to);
        if (from.x >= size_.x || from.y >= size_.y || from.z >= size_.z) return {0, 0};
        const auto begin = static_cast<std::size_t>((from.x * size_.y + from.y) * size_.z);
        return {first_[begin + static_cast<std::size_t>(from.z)],
                first_[begin + static_cast<std::size_t>(std::min(to.z + 1, size_.z))]};
    }
    std::pair<std::size_t, std::size_t> searched_row(const Cell& from, const Cell& to) const;
    void sort_in(std::span<const Eigen::Vector3d> points, std::span<const Cell> cells);
    void sort_by_key(std::span<const Eigen::Vector3d> points, std::span<const Cell> cells);

    double cell_m_ = 1.0;
    Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
    Cell size_;                            ///< cells along each axis, where there is one for each
    std::vector<std::uint32_t> first_;     ///< by cell, and the end; empty where they are too many
    std::vector<std::uint64_t> keys_;      ///< rising; where `first_` is empty
    std::vector<Eigen::Vector3d> points_;  ///< [m] in the order of the keys
    std::vector<std::uint32_t> number_;    ///< of the point at a place
};

}  // namespace graspd
