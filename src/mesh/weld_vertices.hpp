#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

/// Finds vertices that stand at the same place.
///
/// @param vertices     [m], those in use finite
/// @param in_use       per vertex: 0 leaves it alone
/// @param tolerance_m  [m] greatest distance of two equal vertices; 0: bit for bit (but -0 = 0)
/// @return per vertex its leader: the lowest-indexed leader within the tolerance, else itself
/// Complexity O(V) expected.
std::vector<std::uint32_t> weld_vertices(const std::vector<Eigen::Vector3d>& vertices,
                                         const std::vector<char>& in_use, double tolerance_m);

}  // namespace graspd::mesh_detail
