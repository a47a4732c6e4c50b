#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

/// What a gripper part can meet.
enum class CollisionPartner : std::uint8_t { kObject, kObstacle, kPlane, kKeepOut };
/// "object", "obstacle", "plane", "keep_out".
const char* to_string(CollisionPartner partner);

/// A half space that holds everything that must not be touched: normal . p < offset_m.
struct HalfSpace {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit
    double offset_m = 0.0;                              ///< [m]
};

/// A closed surface in the world's frame with its tree; both outlive whoever holds this.
struct CollisionBody {
    const TriangleMesh* mesh = nullptr;  ///< [m]
    const TriangleBvh* bvh = nullptr;    ///< of the same mesh
};

/// Everything around a gripper, in one frame W.
struct CollisionWorld {
    CollisionBody object;
    std::vector<CollisionBody> obstacles;
    std::optional<HalfSpace> plane;
    std::vector<OrientedBox> keep_out;
};

/// The least distance of a set of boxes to a world, and where.
struct Clearance {
    double distance_m = 0.0;  ///< [m] >= 0, at most the greatest distance that was asked for
    std::size_t box = 0;      ///< which of the boxes comes nearest
    CollisionPartner partner = CollisionPartner::kObject;
};

/// Whether a box touches or enters anything of the world, at rest or while it moves along a way
/// without turning: then all that it passes counts, exactly and without sampling.
///
/// Source: Lei & Wisse 2016, Sec. II-F, Fig. 21 (manipulability).
/// Deviation: the paper compares lengths of hand and object. Here separating axes between box and
/// triangle decide, which are exact and several times as fast as FCL's narrow phase, on the tree
/// that the concavity already needs. A box that meets no triangle is tested for lying wholly inside
/// a body.
///
/// @param way_W  [m]
/// @return the first partner in the order object, obstacle, plane, keep-out; none when free
/// Complexity O(log F), ends at the first hit. Pure, so safe to call from any thread. Precondition:
/// finite boxes and ways.
std::optional<CollisionPartner> find_collision(
    const CollisionWorld& world, const OrientedBox& box,
    const Eigen::Vector3d& way_W = Eigen::Vector3d::Zero());

/// The same without the object: what a hand that holds it may run into.
std::optional<CollisionPartner> find_obstruction(
    const CollisionWorld& world, const OrientedBox& box,
    const Eigen::Vector3d& way_W = Eigen::Vector3d::Zero());

/// Least distance of boxes that are free to everything in the world; plane and keep-out boxes
/// count. In closed form, because FCL's distance is up to a tenth too large in some symmetric
/// poses.
/// @param most_m  [m] > 0: distances beyond it are reported as most_m
/// Complexity O(hits near the boxes). Pure.
Clearance find_clearance(const CollisionWorld& world, std::span<const OrientedBox> boxes,
                         double most_m);

}  // namespace graspd
