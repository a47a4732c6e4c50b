#pragma once

#include <array>

#include <Eigen/Core>

namespace graspd {

/// Whether a solid box and a triangle have a point in common; touching counts.
///
/// By separating axes (Gottschalk et al. 1996), exact up to the rounding of double precision. With
/// `half_way` the solid is what the box passes on its way from -half_way to +half_way without
/// turning: the convex hull of both ends, which a box with one more edge direction describes.
///
/// @param half      [m] half extents of the box, which spans [-half, half]
/// @param half_way  [m] half the way, in the box's own axes
/// @param triangle  [m] corners in the box's own axes, from the middle of the way
bool box_meets_triangle(const Eigen::Vector3d& half, const Eigen::Vector3d& half_way,
                        const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace graspd
