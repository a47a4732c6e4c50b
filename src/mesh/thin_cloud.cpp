#include "thin_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "graspd/base/stop.hpp"
#include "graspd/base/stoppable_sort.hpp"
#include "hash_bits.hpp"
#include "weld_vertices.hpp"

namespace graspd::mesh_detail {
namespace {

// Rounding of float coordinates, as in condition_mesh.
constexpr double kSamePlace = 1e-7;
constexpr int kMostRounds = 64;     // each makes the cubes at least 2 % larger
constexpr double kLeastFill = 0.8;  // of the limit: finer cubes are worth another round below it
constexpr int kRefineRounds = 6;
constexpr double kMostCubes = 1048576.0;  // along one axis, so that a key has 60 bits

/// Cube of a point as one number.
class CubeGrid {
public:
    CubeGrid(const Eigen::AlignedBox3d& box, double cube_m) : low_(box.min()), cube_m_(cube_m) {}

    std::uint64_t key(const Eigen::Vector3d& point) const {
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double place = std::floor((point[axis] - low_[axis]) / cube_m_);
            key = (key << 20) | static_cast<std::uint64_t>(std::clamp(place, 0.0, kMostCubes - 1));
        }
        return key;
    }

private:
    Eigen::Vector3d low_;
    double cube_m_;
};

std::size_t count_cubes(const std::vector<Eigen::Vector3d>& points, const CubeGrid& grid) {
    constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    std::vector<std::uint64_t> table(table_size(points.size()), kEmpty);
    std::size_t count = 0, step = 0;
    for (const Eigen::Vector3d& point : points) {
        stop_point(step++);
        const std::uint64_t key = grid.key(point);
        std::size_t slot = spread_bits(key) & (table.size() - 1);
        while (table[slot] != kEmpty && table[slot] != key) slot = (slot + 1) & (table.size() - 1);
        count += table[slot] == kEmpty;
        table[slot] = key;
    }
    return count;
}

/// Edge of the cubes: about the least one with at most max_points cubes. The points of a surface
/// fill cubes as the inverse square of their edge.
double choose_cube_m(const std::vector<Eigen::Vector3d>& points, const Eigen::AlignedBox3d& box,
                     std::size_t max_points) {
    const double limit = static_cast<double>(max_points);
    const double diagonal_m = box.diagonal().norm();
    const double least_m = diagonal_m / kMostCubes;
    double cube_m = std::max(least_m, diagonal_m / std::sqrt(limit));
    double fitting_m = 2.0 * diagonal_m;  // one cube
    for (int round = 0; round < kMostRounds; ++round) {
        const auto count = static_cast<double>(count_cubes(points, CubeGrid(box, cube_m)));
        if (count <= limit) fitting_m = std::min(fitting_m, cube_m);
        const bool fits = fitting_m < 2.0 * diagonal_m;
        if (fits && (count >= kLeastFill * limit || round >= kRefineRounds)) return fitting_m;
        // Aim for nine tenths of the limit, and never stand still while there are too many.
        const double ratio = std::sqrt(count / (0.9 * limit));
        cube_m = std::max(least_m, cube_m * (count > limit ? std::max(1.02, ratio) : ratio));
    }
    return fitting_m;
}

/// Per point the one that stands for its cube.
std::vector<std::uint32_t> choose_in_cubes(const std::vector<Eigen::Vector3d>& points,
                                           const CubeGrid& grid) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> by_cube;
    by_cube.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) by_cube.emplace_back(grid.key(points[i]), i);
    stoppable_sort(by_cube);
    std::vector<std::uint32_t> leader(points.size());
    stop_point();
    for (auto first = by_cube.begin(); first != by_cube.end();) {
        const auto last = std::find_if(first, by_cube.end(),
                                       [&](const auto& e) { return e.first != first->first; });
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (auto it = first; it != last; ++it) sum += points[it->second];
        const Eigen::Vector3d mean = sum / static_cast<double>(last - first);
        const auto best = std::min_element(first, last, [&](const auto& a, const auto& b) {
            return (points[a.second] - mean).squaredNorm() <
                   (points[b.second] - mean).squaredNorm();
        });
        for (auto it = first; it != last; ++it) leader[it->second] = best->second;
        first = last;
    }
    return leader;
}

/// Keeps the points that are their own leader. @return how many go
std::size_t keep_leaders(const std::vector<std::uint32_t>& leader, ThinnedCloud& cloud) {
    std::vector<Eigen::Vector3d> kept;
    std::vector<std::int32_t> place(leader.size(), -1);
    for (std::uint32_t i = 0; i < leader.size(); ++i) {
        if (leader[i] != i) continue;
        place[i] = static_cast<std::int32_t>(kept.size());
        kept.push_back(cloud.points[i]);
    }
    for (std::int32_t& index : cloud.kept_of_input) {
        if (index >= 0) index = place[leader[static_cast<std::size_t>(index)]];
    }
    const std::size_t gone = leader.size() - kept.size();
    cloud.points = std::move(kept);
    return gone;
}

ThinnedCloud sorted_finite(const std::vector<Eigen::Vector3d>& cloud) {
    ThinnedCloud result;
    std::vector<std::uint32_t> order;
    order.reserve(cloud.size());
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
        if (cloud[i].allFinite()) order.push_back(i);
    }
    std::size_t step = 0;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        stop_point(++step);
        return std::lexicographical_compare(cloud[a].begin(), cloud[a].end(), cloud[b].begin(),
                                            cloud[b].end());
    };
    std::ranges::sort(order, before);  // equal points are welded, so their order does not matter
    result.not_finite = cloud.size() - order.size();
    result.kept_of_input.assign(cloud.size(), -1);
    result.points.reserve(order.size());
    for (const std::uint32_t i : order) {
        result.kept_of_input[i] = static_cast<std::int32_t>(result.points.size());
        result.points.push_back(cloud[i]);
    }
    return result;
}

}  // namespace

ThinnedCloud thin_cloud(const std::vector<Eigen::Vector3d>& cloud, std::size_t max_points) {
    ThinnedCloud result = sorted_finite(cloud);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : result.points) box.extend(point);
    if (box.isEmpty() || !std::isfinite(box.diagonal().norm())) return result;
    const std::vector<char> in_use(result.points.size(), 1);
    const double tolerance_m = kSamePlace * box.diagonal().norm();
    result.duplicate = keep_leaders(weld_vertices(result.points, in_use, tolerance_m), result);
    if (result.points.size() <= max_points) return result;
    result.cube_m = choose_cube_m(result.points, box, max_points);
    result.thinned =
        keep_leaders(choose_in_cubes(result.points, CubeGrid(box, result.cube_m)), result);
    return result;
}

void keep_points(const std::vector<char>& keep, ThinnedCloud& cloud) {
    std::vector<std::int32_t> place(keep.size(), -1);
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        place[i] = static_cast<std::int32_t>(kept.size());
        kept.push_back(cloud.points[i]);
    }
    for (std::int32_t& index : cloud.kept_of_input) {
        if (index >= 0) index = place[static_cast<std::size_t>(index)];
    }
    cloud.points = std::move(kept);
}

}  // namespace graspd::mesh_detail
