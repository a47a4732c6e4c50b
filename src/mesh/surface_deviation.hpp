#pragma once

#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

/// How far the points that a surface stands for are from it: the one-sided Hausdorff distance from
/// the points to the surface.
///
/// @param points           [m] as received
/// @param mesh             at least one face
/// @param vertex_of_point  per point: index in mesh.vertices, or -1 for one that was dropped and
///                         does not count
/// @return the finding surface_deviation: value [m], also when it is 0
/// Complexity O(N), and O(F log F) when some point is no corner of a face; at most 20000 such
/// points are measured, evenly chosen.
Finding measure_deviation(const std::vector<Eigen::Vector3d>& points, const TriangleMesh& mesh,
                          const std::vector<std::int32_t>& vertex_of_point);

}  // namespace graspd::mesh_detail
