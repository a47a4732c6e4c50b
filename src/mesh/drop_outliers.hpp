#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace graspd::mesh_detail {

/// Which points belong to a surface, and how many do not.
struct Outliers {
    std::vector<char> keep;  ///< per point
    std::size_t count = 0;
};

/// Finds points that hang together in groups of fewer than `least_group`: specks that sensors leave
/// in the air. Points of one group are joined by steps of at most `reach_m`. Nothing is an outlier
/// when no group holds half of the points: then their distances say nothing.
///
/// @param reach_m  [m] > 0, at least three millionths of the points' extent
/// The result does not depend on the order of the points. Complexity O(N log N + N n), n points
/// within reach.
Outliers find_outliers(const std::vector<Eigen::Vector3d>& points, double reach_m,
                       std::size_t least_group);

}  // namespace graspd::mesh_detail
