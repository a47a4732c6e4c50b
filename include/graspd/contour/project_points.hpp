#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace graspd {

/// Projects points on the plane in which a concavity is analysed.
///
/// Source: Lei & Wisse 2016, Sec. II-D, Fig. 6.
///
/// @param points_O  (N) points [m], frame O
/// @param X_OW      pose of the working frame W in O; its third axis is the plane's normal (II-C)
/// @return (N) first two coordinates in W [m], in the order of `points_O`; a point that is not
///         finite stays so, and the stage after this one names it
/// Complexity O(N). Pure, so safe to call from any thread.
std::vector<Eigen::Vector2d> project_points(std::span<const Eigen::Vector3d> points_O,
                                            const Eigen::Isometry3d& X_OW);

}  // namespace graspd
