#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace graspd::mesh_detail {

/// The points that are left of a cloud, in lexicographic order, so that the order in which a cloud
/// was sent does not matter.
struct ThinnedCloud {
    std::vector<Eigen::Vector3d> points;      ///< [m] a subset of the input
    std::vector<std::int32_t> kept_of_input;  ///< per input point: index in points, or -1
    std::size_t not_finite = 0;               ///< dropped
    std::size_t duplicate = 0;                ///< stood where an earlier one stands
    std::size_t thinned = 0;                  ///< stand behind another point of their cube
    double cube_m = 0.0;                      ///< [m] edge of the cubes, 0 when none was needed
};

/// Drops points that are not finite or stand at the same place; when more than max_points are left,
/// keeps the one nearest to the mean in every cube of a grid as fine as the limit allows.
///
/// @param max_points  >= 1
/// Complexity O(N log N).
ThinnedCloud thin_cloud(const std::vector<Eigen::Vector3d>& cloud, std::size_t max_points);

/// Drops the points whose entry in `keep` is 0.
void keep_points(const std::vector<char>& keep, ThinnedCloud& cloud);

}  // namespace graspd::mesh_detail
