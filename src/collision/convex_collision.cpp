#include "graspd/collision/convex_collision.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <memory>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "box_distance.hpp"
#include "convex_distance.hpp"
#include "graspd/base/box_triangle.hpp"

namespace graspd {
namespace {

using collision_detail::Corners;
using collision_detail::corners_of;
using collision_detail::distance_m;
using Eigen::Vector3d;

std::array<Vector3d, 8> corners_of(const OrientedBox& box) {
    std::array<Vector3d, 8> corners;
    for (std::size_t k = 0; k < 8; ++k) {
        const Vector3d side((k & 1u) != 0 ? 1 : -1, (k & 2u) != 0 ? 1 : -1, (k & 4u) != 0 ? 1 : -1);
        corners[k] = box.pose * side.cwiseProduct(box.half_extent);
    }
    return corners;
}

/// A body with the box around it and what FCL needs of it.
class Probe {
public:
    explicit Probe(const ConvexBody& body)
        : body_(body),
          box_(box_around(body)),
          to_box_(box_.pose.inverse(Eigen::Isometry)),
          // Only its points count: FCL walks along faces for speed alone, and from 33 points on.
          shape_(std::make_shared<const std::vector<fcl::Vector3d>>(body.points_W.begin(),
                                                                    body.points_W.end()),
                 0, std::make_shared<const std::vector<int>>()) {}

    bool hits(const CollisionBody& other) const {
        const auto near = other.bvh->faces_near(box_, 0.0);
        const bool hit = std::ranges::any_of(
            near, [&](std::uint32_t face) { return hits(corners_of(*other.mesh, face)); });
        return hit || other.bvh->contains(body_.points_W.front());
    }
    bool hits(const HalfSpace& plane) const { return height_over(plane) <= 0.0; }
    bool hits(const OrientedBox& keep_out) const {
        return solver_.shapeIntersect(fcl::Boxd(2.0 * keep_out.half_extent), keep_out.pose, shape_,
                                      Eigen::Isometry3d::Identity(), nullptr);
    }
    double height_over(const HalfSpace& plane) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Vector3d& p : body_.points_W) least = std::min(least, plane.normal.dot(p));
        return least - plane.offset_m;
    }
    double distance_to(const CollisionBody& other, double most_m) const;
    const OrientedBox& box() const { return box_; }

private:
    bool hits(const Corners& t) const {
        return box_meets_triangle(box_.half_extent, Vector3d::Zero(),
                                  {to_box_ * t[0], to_box_ * t[1], to_box_ * t[2]}) &&
               solver_.shapeTriangleIntersect(shape_, Eigen::Isometry3d::Identity(), t[0], t[1],
                                              t[2]);
    }

    const ConvexBody& body_;
    OrientedBox box_;
    Eigen::Isometry3d to_box_;
    fcl::Convexd shape_;
    fcl::detail::GJKSolver_libccdd solver_;
};

double Probe::distance_to(const CollisionBody& other, double most_m) const {
    constexpr double kFirstRing_m = 0.002;
    for (double ring_m = std::min(kFirstRing_m, most_m);; ring_m = std::min(4.0 * ring_m, most_m)) {
        double least = most_m;
        for (const std::uint32_t face : other.bvh->faces_near(box_, ring_m)) {
            const Corners corners = corners_of(*other.mesh, face);
            if (distance_m(box_, corners, least) >= least) continue;  // the body lies in its box
            least = std::min(least, distance_m(body_.points_W, corners, least));
        }
        // What lies beyond the ring is farther away than the ring is wide.
        if (least <= ring_m || ring_m >= most_m) return least;
    }
}

}  // namespace

OrientedBox box_around(const ConvexBody& body) {
    assert(!body.points_W.empty());
    Eigen::AlignedBox3d bounds;
    for (const Vector3d& point : body.points_W) bounds.extend(body.axes_W.transpose() * point);
    OrientedBox box;
    box.pose.linear() = body.axes_W;
    box.pose.translation() = body.axes_W * bounds.center();
    box.half_extent = 0.5 * bounds.sizes();
    return box;
}

ConvexBody swept(ConvexBody body, const Vector3d& way_W) {
    const std::size_t count = body.points_W.size();
    body.points_W.reserve(2 * count);
    for (std::size_t i = 0; i < count; ++i) body.points_W.push_back(body.points_W[i] + way_W);
    return body;
}

ConvexBody grown(const ConvexBody& body, double by_m) {
    ConvexBody out{{}, body.axes_W};
    out.points_W.reserve(8 * body.points_W.size());
    OrientedBox cube;
    cube.half_extent.setConstant(by_m);
    for (const Vector3d& point : body.points_W) {
        cube.pose.translation() = point;
        for (const Vector3d& corner : corners_of(cube)) out.points_W.push_back(corner);
    }
    return out;
}

std::optional<CollisionPartner> find_collision(const CollisionWorld& world,
                                               const ConvexBody& body) {
    if (!find_collision(world, box_around(body))) return std::nullopt;
    if (Probe(body).hits(world.object)) return CollisionPartner::kObject;
    return find_obstruction(world, body);
}

std::optional<CollisionPartner> find_obstruction(const CollisionWorld& world,
                                                 const ConvexBody& body) {
    const Probe probe(body);
    const auto hit = [&](const auto& thing) { return probe.hits(thing); };
    if (!find_obstruction(world, probe.box())) return std::nullopt;
    if (std::ranges::any_of(world.obstacles, hit)) return CollisionPartner::kObstacle;
    if (world.plane && probe.hits(*world.plane)) return CollisionPartner::kPlane;
    if (std::ranges::any_of(world.keep_out, hit)) return CollisionPartner::kKeepOut;
    return std::nullopt;
}

Clearance find_clearance(const CollisionWorld& world, std::span<const ConvexBody> bodies,
                         double most_m) {
    Clearance least{most_m, 0, CollisionPartner::kObject};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Probe probe(bodies[i]);
        const auto consider = [&](double distance_m, CollisionPartner partner) {
            if (distance_m < least.distance_m) least = {std::max(0.0, distance_m), i, partner};
        };
        consider(probe.distance_to(world.object, least.distance_m), CollisionPartner::kObject);
        for (const CollisionBody& obstacle : world.obstacles) {
            consider(probe.distance_to(obstacle, least.distance_m), CollisionPartner::kObstacle);
        }
        if (world.plane) consider(probe.height_over(*world.plane), CollisionPartner::kPlane);
        for (const OrientedBox& keep_out : world.keep_out) {
            consider(distance_m(bodies[i].points_W, corners_of(keep_out), least.distance_m),
                     CollisionPartner::kKeepOut);
        }
        if (least.distance_m <= 0.0) break;
    }
    return least;
}

}  // namespace graspd
