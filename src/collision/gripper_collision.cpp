#include "graspd/collision/gripper_collision.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "box_distance.hpp"
#include "box_overlap.hpp"

namespace graspd {
namespace {

using collision_detail::boxes_meet;
using collision_detail::corners_of;
using collision_detail::distance_m;

bool hits_body(const CollisionBody& body, const OrientedBox& box, const Eigen::Vector3d& way) {
    // Without a common triangle the box lies either wholly outside or wholly inside.
    return body.bvh->meets_box(box, way) || body.bvh->surrounds(box);
}

/// How far the box's lowest corner stands above the plane; negative below it.
double height_over(const HalfSpace& plane, const OrientedBox& box) {
    const Eigen::Vector3d along = box.pose.linear().transpose() * plane.normal;
    return plane.normal.dot(box.pose.translation()) - plane.offset_m -
           along.cwiseAbs().dot(box.half_extent);
}

double distance_to_body(const CollisionBody& body, const OrientedBox& box, double most_m) {
    constexpr double kFirstRing_m = 0.002;
    for (double ring_m = std::min(kFirstRing_m, most_m);; ring_m = std::min(4.0 * ring_m, most_m)) {
        double least = most_m;
        for (const std::uint32_t face : body.bvh->faces_near(box, ring_m)) {
            least = std::min(least, distance_m(box, corners_of(*body.mesh, face), least));
        }
        // What lies beyond the ring is farther away than the ring is wide.
        if (least <= ring_m || ring_m >= most_m) return least;
    }
}

}  // namespace

const char* to_string(CollisionPartner partner) {
    switch (partner) {
        case CollisionPartner::kObject: return "object";
        case CollisionPartner::kObstacle: return "obstacle";
        case CollisionPartner::kPlane: return "plane";
        case CollisionPartner::kKeepOut: return "keep_out";
    }
    return "unknown";
}

std::optional<CollisionPartner> find_collision(const CollisionWorld& world, const OrientedBox& box,
                                               const Eigen::Vector3d& way) {
    assert(box.pose.matrix().allFinite() && box.half_extent.allFinite() && way.allFinite());
    if (hits_body(world.object, box, way)) return CollisionPartner::kObject;
    return find_obstruction(world, box, way);
}

std::optional<CollisionPartner> find_obstruction(const CollisionWorld& world,
                                                 const OrientedBox& box,
                                                 const Eigen::Vector3d& way) {
    for (const CollisionBody& obstacle : world.obstacles) {
        if (hits_body(obstacle, box, way)) return CollisionPartner::kObstacle;
    }
    if (world.plane &&
        height_over(*world.plane, box) + std::min(0.0, world.plane->normal.dot(way)) <= 0.0) {
        return CollisionPartner::kPlane;
    }
    for (const OrientedBox& keep_out : world.keep_out) {
        if (boxes_meet(keep_out, box, way)) return CollisionPartner::kKeepOut;
    }
    return std::nullopt;
}

Clearance find_clearance(const CollisionWorld& world, std::span<const OrientedBox> boxes,
                         double most_m) {
    Clearance least{most_m, 0, CollisionPartner::kObject};
    const auto consider = [&](double distance_m, std::size_t box, CollisionPartner partner) {
        if (distance_m < least.distance_m) least = {std::max(0.0, distance_m), box, partner};
    };
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        consider(distance_to_body(world.object, boxes[i], least.distance_m), i,
                 CollisionPartner::kObject);
        for (const CollisionBody& obstacle : world.obstacles) {
            consider(distance_to_body(obstacle, boxes[i], least.distance_m), i,
                     CollisionPartner::kObstacle);
        }
        if (world.plane) {
            consider(height_over(*world.plane, boxes[i]), i, CollisionPartner::kPlane);
        }
        for (const OrientedBox& keep_out : world.keep_out) {
            consider(distance_m(keep_out, boxes[i], least.distance_m), i,
                     CollisionPartner::kKeepOut);
        }
        if (least.distance_m <= 0.0) break;
    }
    return least;
}

}  // namespace graspd
