#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/collision/gripper_collision.hpp"

namespace graspd {

/// A solid in the world's frame: the hull of its points.
struct ConvexBody {
    std::vector<Eigen::Vector3d> points_W;                 ///< [m] one or more
    Eigen::Matrix3d axes_W = Eigen::Matrix3d::Identity();  ///< a box along them fits it well
};

/// The box around a body along its own axes.
OrientedBox box_around(const ConvexBody& body);

/// What a body passes on a straight way without turning: the hull of both ends.
ConvexBody swept(ConvexBody body, const Eigen::Vector3d& way_W);

/// A body that holds all points within a distance of the first one: the hull of cubes.
ConvexBody grown(const ConvexBody& body, double by_m);

/// Whether a convex body touches or enters anything of the world.
///
/// Behind the box around it, which is asked first, FCL's narrow phase (GJK of libccd) decides for
/// every triangle that meets this box. It misses depths below 1e-6 m. A body that meets no triangle
/// is tested for lying wholly inside.
/// @return the first partner in the order object, obstacle, plane, keep-out; none when free
std::optional<CollisionPartner> find_collision(const CollisionWorld& world, const ConvexBody& body);

/// The same without the object.
std::optional<CollisionPartner> find_obstruction(const CollisionWorld& world,
                                                 const ConvexBody& body);

/// Least distance of bodies that are free to everything in the world, by GJK of our own, which ends
/// when a lower bound comes within 1e-9 m (FCL's has no such bound and errs by up to a tenth).
/// @param most_m  [m] > 0: distances beyond it are reported as most_m
Clearance find_clearance(const CollisionWorld& world, std::span<const ConvexBody> bodies,
                         double most_m);

}  // namespace graspd
