#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/mesh/triangulate_cloud.hpp"

namespace graspd::mesh_detail {

// What PCL and CGAL do for triangulate_cloud, each in a source of its own. Points are centred and
// of about unit size; both work alike in any order of calls and threads.

/// Median distance to the nearest neighbour (PCL's kd-tree). Precondition: at least 2 points.
Result<double> median_spacing(const std::vector<Eigen::Vector3d>& points);

/// CGAL's advancing front. @return triangles, possibly none; kInternal when CGAL throws
Result<std::vector<Triangle>> advance_front(const std::vector<Eigen::Vector3d>& points);

/// PCL's greedy projection over normals from the nearest neighbours.
/// @param spacing  median_spacing of the points
/// @return triangles, possibly none; kInternal when PCL throws
Result<std::vector<Triangle>> project_greedily(const std::vector<Eigen::Vector3d>& points,
                                               double spacing,
                                               const TriangulateCloudConfig& config);

}  // namespace graspd::mesh_detail
