// Collision, clearance and the tree's near faces against CGAL's exact predicates over every
// triangle, one by one.

#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "graspd/collision/gripper_collision.hpp"
#include "support/exact_surface.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Eigen::Vector3d;

constexpr double kBorderline_m = 1e-9;  // poses that near do not count

double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1.0p-53;
}
Vector3d random_vector(std::mt19937_64& random) {
    return 2.0 * Vector3d(fraction(random), fraction(random), fraction(random)) - Vector3d::Ones();
}

struct Object {
    Object(const char* n, TriangleMesh m) : name(n), mesh(std::move(m)), tree(mesh, 1e-7) {}
    const char* name;
    TriangleMesh mesh;
    TriangleBvh tree;
};
std::vector<Object> objects() {
    std::vector<Object> list;
    list.emplace_back("box_hourglass",
                      test::moved(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 800),
                                  test::random_pose(1)));
    list.emplace_back("cup", test::moved(test::cup(0.04, 0.09, 0.006, 800), test::random_pose(2)));
    list.emplace_back("torus", test::torus(0.05, 0.02, 800));
    return list;
}

/// A box of a finger's or a palm's size, most of them near the surface.
OrientedBox random_box(const TriangleMesh& mesh, std::mt19937_64& random) {
    OrientedBox box;
    const Vector3d unit(fraction(random), fraction(random), fraction(random));
    box.half_extent = Vector3d::Constant(0.001) + 0.02 * unit.cwiseProduct(unit);
    box.pose.linear() =
        Eigen::AngleAxisd(std::numbers::pi * fraction(random), random_vector(random).normalized())
            .toRotationMatrix();
    const Vector3d& vertex = mesh.vertices[random() % mesh.vertices.size()];
    box.pose.translation() = vertex + 0.04 * random_vector(random);
    return box;
}

using Corners = std::array<Vector3d, 3>;

/// A face in the box's coordinates: rounding shifts it by less than 1e-16.
Corners corners_in(const OrientedBox& box, const TriangleMesh& mesh, const Triangle& face) {
    const Eigen::Isometry3d to_box = box.pose.inverse();
    return {to_box * mesh.vertices[face[0]], to_box * mesh.vertices[face[1]],
            to_box * mesh.vertices[face[2]]};
}
Kernel::Point_3 point(const Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}
Kernel::Triangle_3 triangle(const Corners& c) {
    return {point(c[0]), point(c[1]), point(c[2])};
}

bool meets_a_face(const OrientedBox& box, double grown_m, const TriangleMesh& mesh) {
    const Vector3d half = box.half_extent + Vector3d::Constant(grown_m);
    const Kernel::Iso_cuboid_3 cuboid(point(-half), point(half));
    return std::ranges::any_of(mesh.faces, [&](const Triangle& face) {
        return CGAL::do_intersect(cuboid, triangle(corners_in(box, mesh, face)));
    });
}

/// Inside by the solid angle that the surface fills: 4 pi inside, 0 outside.
bool inside(const Vector3d& p, const TriangleMesh& mesh) {
    double angle = 0.0;
    for (const Triangle& t : mesh.faces) {
        const Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
                       c = mesh.vertices[t[2]] - p;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        angle += 2.0 * std::atan2(a.dot(b.cross(c)), below);
    }
    return angle > 2.0 * std::numbers::pi;
}

TEST(GripperCollisionOracle, CollisionAgreesWithExactPredicatesOverAllFaces) {
    int within_all = 0;
    for (const Object& object : objects()) {
        CollisionWorld world;
        world.object = {&object.mesh, &object.tree};
        std::mt19937_64 random(7);
        int hits = 0, within = 0, free = 0, skipped = 0;
        for (int i = 0; i < 2000; ++i) {
            const OrientedBox box = random_box(object.mesh, random);
            const bool hit = meets_a_face(box, -kBorderline_m, object.mesh);
            if (!hit && meets_a_face(box, kBorderline_m, object.mesh)) {
                ++skipped;
                continue;
            }
            const bool wholly = !hit && inside(box.pose.translation(), object.mesh);
            ++(hit ? hits : (wholly ? within : free));
            EXPECT_EQ(find_collision(world, box).has_value(), hit || wholly)
                << object.name << " pose " << i;
        }
        EXPECT_GT(hits, 300) << object.name;
        EXPECT_GT(free, 300) << object.name;
        within_all += within;
        EXPECT_LT(skipped, 10) << object.name;
    }
    EXPECT_GT(within_all, 10);  // wholly inside the solid
}

TEST(GripperCollisionOracle, ClearanceAgreesWithTheDistanceToEveryFace) {
    for (const Object& object : objects()) {
        CollisionWorld world;
        world.object = {&object.mesh, &object.tree};
        std::mt19937_64 random(8);
        int compared = 0;
        for (int i = 0; i < 600; ++i) {
            const OrientedBox box = random_box(object.mesh, random);
            if (find_collision(world, box)) continue;
            double exact_m = std::numeric_limits<double>::infinity();
            for (const Triangle& face : object.mesh.faces) {
                exact_m = std::min(
                    exact_m,
                    test::exact_distance_m(box.half_extent, corners_in(box, object.mesh, face)));
            }
            const auto found = find_clearance(world, std::vector{box}, 0.03);
            EXPECT_NEAR(found.distance_m, std::min(exact_m, 0.03), 1e-9)
                << object.name << " pose " << i;
            ++compared;
        }
        EXPECT_GT(compared, 100) << object.name;
    }
}

// No face within the distance may be missing; of those farther away most must be left out.
TEST(GripperCollisionOracle, NoNearFaceIsMissing) {
    for (const Object& object : objects()) {
        std::mt19937_64 random(9);
        std::size_t listed = 0, near = 0;
        for (int i = 0; i < 300; ++i) {
            const OrientedBox box = random_box(object.mesh, random);
            const double within_m = std::array{0.0, 1e-4, 2e-3, 0.01}[random() % 4];
            const auto faces = object.tree.faces_near(box, within_m);
            EXPECT_TRUE(std::ranges::is_sorted(faces));
            EXPECT_EQ(std::ranges::adjacent_find(faces), faces.end());
            listed += faces.size();
            const Kernel::Iso_cuboid_3 cuboid(point(-box.half_extent), point(box.half_extent));
            for (std::uint32_t f = 0; f < object.mesh.faces.size(); ++f) {
                const Corners c = corners_in(box, object.mesh, object.mesh.faces[f]);
                const bool meets = CGAL::do_intersect(cuboid, triangle(c));
                if (!meets && test::exact_distance_m(box.half_extent, c) > within_m) continue;
                ++near;
                EXPECT_TRUE(std::ranges::binary_search(faces, f))
                    << object.name << " pose " << i << " face " << f;
            }
        }
        EXPECT_GT(near, 1000U) << object.name;
        EXPECT_LT(listed, 6 * near) << object.name;
    }
}

}  // namespace
}  // namespace graspd
