#pragma once

#include "graspd/collision/gripper_collision.hpp"

namespace graspd::collision_detail {

/// Whether a body meets another one while it moves from `from_W` by `way_W` without turning: some
/// face passes through a face of the other's, or one lies within the other. Touching counts. Exact
/// up to rounding: every pair of faces whose boxes meet is judged by separating axes.
/// @param from_W  [m] shift of the moving body where its way begins
/// @param way_W   [m]
/// Complexity O(faces near the other body, log of its faces).
bool sweep_meets(const CollisionBody& moving, const Eigen::Vector3d& from_W,
                 const Eigen::Vector3d& way_W, const CollisionBody& standing);

}  // namespace graspd::collision_detail
