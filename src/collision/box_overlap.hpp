#pragma once

#include "graspd/base/geometry.hpp"

namespace graspd::collision_detail {

/// Whether two solid boxes in the same frame W have a point in common while one of them moves along
/// a way without turning; touching counts. Exact up to rounding, by separating axes.
/// @param way_W  [m]
bool boxes_meet(const OrientedBox& standing, const OrientedBox& moving,
                const Eigen::Vector3d& way_W);

}  // namespace graspd::collision_detail
