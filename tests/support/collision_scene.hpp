#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "graspd/collision/manipulability.hpp"
#include "support/shapes.hpp"

namespace graspd::test {

/// All lengths in mm: pads' gap along x, fingers 10 thick, 20 wide (|y| <= 10), from z = -35 to the
/// tip at 10; palm |x| <= 60, |y| <= 20, z from -115 to -35, in G.
inline Gripper parallel_85() {
    Gripper gripper;  // the struct's defaults are its dimensions
    gripper.name = "parallel_85";
    return gripper;
}

/// Bodies and what points at them.
class CollisionScene {
public:
    explicit CollisionScene(TriangleMesh object) { world_.object = add(std::move(object)); }
    /// With an object that is out of the way.
    CollisionScene() : CollisionScene(moved_box({0.01, 0.01, 0.01}, {9, 9, 9})) {}
    CollisionScene& obstacle(const Eigen::Vector3d& size, const Eigen::Vector3d& center) {
        world_.obstacles.push_back(add(moved_box(size, center)));
        return *this;
    }
    CollisionScene& keep_out(const Eigen::Vector3d& half, const Eigen::Vector3d& center) {
        OrientedBox box;
        box.half_extent = half;
        box.pose.translation() = center;
        world_.keep_out.push_back(box);
        return *this;
    }
    CollisionScene& plane(const Eigen::Vector3d& normal, double offset_m) {
        world_.plane = HalfSpace{normal, offset_m};
        return *this;
    }
    const CollisionWorld& world() const { return world_; }
    MotionCheck check(const Eigen::Isometry3d& X_WG, double width_m,
                      const Gripper& gripper = parallel_85(),
                      const ManipulabilityConfig& config = {}) const {
        return check_motion(world_, gripper, X_WG, width_m, config);
    }

private:
    struct Body {
        TriangleMesh mesh;
        TriangleBvh tree;
    };
    static TriangleMesh moved_box(const Eigen::Vector3d& size, const Eigen::Vector3d& center) {
        return moved(box(size), Eigen::Isometry3d(Eigen::Translation3d(center)));
    }
    CollisionBody add(TriangleMesh mesh) {
        TriangleBvh tree(mesh, 1e-7);
        bodies_.push_back(std::make_unique<Body>(Body{std::move(mesh), std::move(tree)}));
        return {&bodies_.back()->mesh, &bodies_.back()->tree};
    }
    std::vector<std::unique_ptr<Body>> bodies_;
    CollisionWorld world_;
};

/// A hand that comes from above (Gz down, Gx along x) with its TCP at a place.
inline Eigen::Isometry3d from_above(double x, double z) {
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    X_WG.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    X_WG.translation() << x, 0, z;
    return X_WG;
}

}  // namespace graspd::test
