#include "graspd/collision/gripper_collision.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "box_distance.hpp"

namespace graspd {
namespace {

using collision_detail::Corners;
using collision_detail::distance_m;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t face) {
    const Triangle& t = mesh.faces[face];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

fcl::Boxd shape_of(const OrientedBox& box) {
    return fcl::Boxd(2.0 * box.half_extent);
}

bool hits_body(const CollisionBody& body, const OrientedBox& box) {
    const fcl::detail::GJKSolver_libccdd solver;
    const fcl::Boxd shape = shape_of(box);
    const std::vector<std::uint32_t> near = body.bvh->faces_near(box, 0.0);
    const bool hit = std::ranges::any_of(near, [&](std::uint32_t face) {
        const Corners t = corners_of(*body.mesh, face);
        return solver.shapeTriangleIntersect(shape, box.pose, t[0], t[1], t[2]);
    });
    // Without a common triangle the box lies either wholly outside or wholly inside.
    return hit || body.bvh->contains(box.pose.translation());
}

/// How far the box's lowest corner stands above the plane; negative below it.
double height_over(const HalfSpace& plane, const OrientedBox& box) {
    const Eigen::Vector3d along = box.pose.linear().transpose() * plane.normal;
    return plane.normal.dot(box.pose.translation()) - plane.offset_m -
           along.cwiseAbs().dot(box.half_extent);
}

bool hits_box(const OrientedBox& keep_out, const OrientedBox& box) {
    return fcl::detail::GJKSolver_libccdd().shapeIntersect(shape_of(keep_out), keep_out.pose,
                                                           shape_of(box), box.pose, nullptr);
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

std::optional<CollisionPartner> find_collision(const CollisionWorld& world,
                                               const OrientedBox& box) {
    assert(box.pose.matrix().allFinite() && box.half_extent.allFinite());
    if (hits_body(world.object, box)) return CollisionPartner::kObject;
    for (const CollisionBody& obstacle : world.obstacles) {
        if (hits_body(obstacle, box)) return CollisionPartner::kObstacle;
    }
    if (world.plane && height_over(*world.plane, box) <= 0.0) return CollisionPartner::kPlane;
    for (const OrientedBox& keep_out : world.keep_out) {
        if (hits_box(keep_out, box)) return CollisionPartner::kKeepOut;
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
