#pragma once

#include <vector>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

/// The points that are corners of the convex hull of all, in their order.
/// @param points  [m] 4 or more, not in one plane
/// @return kDegenerate for fewer points or where they have no volume, with their number
Result<std::vector<Eigen::Vector3d>> hull_points(const std::vector<Eigen::Vector3d>& points);

}  // namespace graspd
