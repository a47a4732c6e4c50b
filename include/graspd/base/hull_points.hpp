#pragma once

#include <vector>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// The points that are corners of the convex hull of all, in their order.
/// @param points  [m] 4 or more, not in one plane
/// @return kDegenerate for fewer points or where they have no volume, with their number
Result<std::vector<Eigen::Vector3d>> hull_points(const std::vector<Eigen::Vector3d>& points);

/// The surface of the convex hull: its corners in their order, faces counter-clockwise seen from
/// outside. Flat sides of more than three corners are cut into triangles.
/// @param points  as above [m] @return likewise
Result<TriangleMesh> hull_mesh(const std::vector<Eigen::Vector3d>& points);

}  // namespace graspd
