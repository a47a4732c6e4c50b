// A whole gripper in 100,000 poses against CGAL: exact predicates for what is free, the distance to
// every face nearby for the clearance. Half of the poses stand within 60 micrometres of contact.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "graspd/base/box_triangle.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/collision/convex_collision.hpp"
#include "graspd/collision/gripper_collision.hpp"
#include "graspd/collision/manipulability.hpp"
#include "support/exact_surface.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using Hand = std::vector<OrientedBox>;
using Corners = std::array<Vector3d, 3>;

constexpr int kPosesAnObject = 25000;
constexpr double kBorderline_m = 1e-9;  // a thousandth of the penetration that may be overlooked
constexpr double kMostClearance_m = 0.005;

double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1.0p-53;
}
Vector3d random_vector(std::mt19937_64& random) {
    return 2.0 * Vector3d(fraction(random), fraction(random), fraction(random)) - Vector3d::Ones();
}
Eigen::Matrix3d random_turn(std::mt19937_64& random) {
    return Eigen::AngleAxisd(std::numbers::pi * fraction(random),
                             random_vector(random).normalized())
        .toRotationMatrix();
}

struct Object {
    Object(std::string n, TriangleMesh m)
        : name(std::move(n)), mesh(std::move(m)), tree(mesh, 1e-7), exact(mesh) {
        world.object = {&mesh, &tree};
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    std::string name;
    TriangleMesh mesh;
    TriangleBvh tree;
    test::ExactSurface exact;
    CollisionWorld world;
};

enum class Truth { kFree, kHit, kWithin, kBorderline };

OrientedBox grown(OrientedBox box, double by_m) {
    box.half_extent.array() += by_m;
    return box;
}

/// Two triangles for each of the six faces.
bool skin_meets(const Object& object, const OrientedBox& box) {
    const auto c = test::corners_of(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = std::size_t{1} << ((axis + 1) % 3);
        const std::size_t v = std::size_t{1} << ((axis + 2) % 3);
        for (const std::size_t k : {std::size_t{0}, std::size_t{1} << axis}) {
            if (object.exact.meets({c[k], c[k | u], c[k | u | v]}) ||
                object.exact.meets({c[k], c[k | v], c[k | u | v]})) {
                return true;
            }
        }
    }
    return false;
}

/// The object may also lie wholly within the box.
bool solid_meets(const Object& object, const OrientedBox& box) {
    const Vector3d corner = box.pose.inverse() * object.mesh.vertices.front();
    return (corner.cwiseAbs().array() <= box.half_extent.array()).all() || skin_meets(object, box);
}

Truth truth_about(const Object& object, const OrientedBox& box) {
    if (!solid_meets(object, grown(box, kBorderline_m))) {
        const bool may = object.tree.bounds().contains(box.pose.translation());
        return may && object.exact.contains(box.pose.translation()) ? Truth::kWithin : Truth::kFree;
    }
    return solid_meets(object, grown(box, -kBorderline_m)) ? Truth::kHit : Truth::kBorderline;
}

/// A hand at its grasp or on its way there (the boxes that it sweeps), around the object.
Hand random_hand(const Object& object, std::mt19937_64& random) {
    Gripper gripper;
    gripper.finger_thickness_m = 0.002 + 0.02 * fraction(random);
    gripper.palm_height_m = 0.01 + 0.05 * fraction(random);
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    X_WG.linear() = random_turn(random);
    const auto& vertices = object.mesh.vertices;
    X_WG.translation() = vertices[random() % vertices.size()] + 0.02 * random_vector(random);
    const double way_m = random() % 2 == 0 ? 0.0 : 0.1 * fraction(random);
    const double open_m = (0.05 + 0.95 * fraction(random)) * gripper.max_width_m;
    return swept_approach(gripper, X_WG, 0.5 * open_m, open_m, way_m);
}

Hand moved(Hand hand, const Vector3d& by) {
    for (OrientedBox& box : hand) box.pose.translation() += by;
    return hand;
}

bool found_free(const Object& object, const Hand& hand) {
    return std::ranges::none_of(hand, [&](const OrientedBox& box) {
        return find_collision(object.world, box).has_value();
    });
}

/// Along a random line to where free and not free meet.
Hand brought_to_contact(const Object& object, const Hand& hand, std::mt19937_64& random) {
    const Vector3d line = random_vector(random).normalized();
    double free_m = 0.5, hit_m = 0.0;
    if (found_free(object, hand)) std::swap(free_m, hit_m);
    for (int i = 0; i < 13; ++i) {
        const double middle_m = 0.5 * (free_m + hit_m);
        (found_free(object, moved(hand, middle_m * line)) ? free_m : hit_m) = middle_m;
    }
    return moved(hand, (random() % 2 == 0 ? free_m : hit_m) * line);
}

double exact_clearance_m(const Object& object, const Hand& hand) {
    double least_m = kMostClearance_m;
    for (const OrientedBox& box : hand) {
        const Vector3d reach =
            box.pose.linear().cwiseAbs() * box.half_extent + Vector3d::Constant(least_m);
        const Vector3d& center = box.pose.translation();
        const Eigen::Isometry3d to_box = box.pose.inverse();
        for (const std::uint32_t face : object.exact.faces_in({center - reach, center + reach})) {
            Corners corners;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = to_box * object.mesh.vertices[object.mesh.faces[face][i]];
            }
            const Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
            const Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
            const Vector3d apart =
                (low - box.half_extent).cwiseMax(-box.half_extent - high).cwiseMax(0.0);
            if (apart.norm() >= least_m) continue;
            least_m = std::min(least_m, test::exact_distance_m(box.half_extent, corners));
        }
    }
    return least_m;
}

struct Tally {
    int hit = 0, free = 0, within = 0, borderline = 0, near = 0;
};

/// Every part of one hand, and the clearance when it is free.
void compare(const Object& object, const Hand& hand, int pose, Tally& tally) {
    bool all_free = true;
    for (const OrientedBox& box : hand) {
        const Truth truth = truth_about(object, box);
        ++(truth == Truth::kHit      ? tally.hit
           : truth == Truth::kFree   ? tally.free
           : truth == Truth::kWithin ? tally.within
                                     : tally.borderline);
        all_free = all_free && truth == Truth::kFree;
        if (truth == Truth::kBorderline) continue;
        ASSERT_EQ(find_collision(object.world, box).has_value(), truth != Truth::kFree)
            << object.name << " pose " << pose;
    }
    if (!all_free) return;
    const double found_m = find_clearance(object.world, hand, kMostClearance_m).distance_m;
    tally.near += found_m < kMostClearance_m;
    ASSERT_NEAR(found_m, exact_clearance_m(object, hand), 1e-7) << object.name << " pose " << pose;
}

void compare_poses(const Object& object) {
    std::mt19937_64 random(11);
    Tally tally;
    for (int pose = 0; pose < kPosesAnObject; ++pose) {
        Hand hand = random_hand(object, random);
        if (pose % 2 == 0) hand = brought_to_contact(object, hand, random);
        compare(object, hand, pose, tally);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(tally.hit, 5000) << object.name;
    EXPECT_GT(tally.free, 5000) << object.name;
    EXPECT_GT(tally.near, 3000) << object.name;
    EXPECT_LT(tally.borderline, 20) << object.name;
    testing::Test::RecordProperty(object.name + "_within", tally.within);
}

TEST(GripperPosesOracle, BoxHourglass) {
    compare_poses(
        {"box_hourglass", test::moved(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 800),
                                      test::random_pose(1))});
}
TEST(GripperPosesOracle, Cup) {
    compare_poses({"cup", test::moved(test::cup(0.04, 0.09, 0.006, 3000), test::random_pose(2))});
}
TEST(GripperPosesOracle, Torus) {
    compare_poses({"torus", test::torus(0.05, 0.02, 2000)});
}
// As large as a scan, with walls so thick that a finger has room in them.
TEST(GripperPosesOracle, Channel) {
    compare_poses({"channel", test::moved(test::u_channel(0.06, 0.05, 0.03, 0.12, 16000),
                                          test::random_pose(3))});
}

// All that a box passes is the hull of its corners at both ends; ways along its axes and in the
// plane of two of them count too.
TEST(GripperPosesOracle, WhatABoxPassesIsTheHullOfBothEnds) {
    const Object object("cup", test::cup(0.04, 0.09, 0.006, 800));
    std::mt19937_64 random(12);
    int hits = 0, free = 0;
    for (int i = 0; i < 6000; ++i) {
        OrientedBox box;
        const Vector3d unit(fraction(random), fraction(random), fraction(random));
        box.half_extent = Vector3d::Constant(0.0005) + 0.01 * unit.cwiseProduct(unit);
        box.pose.linear() = random_turn(random);
        box.pose.translation() = object.mesh.vertices[random() % object.mesh.vertices.size()] +
                                 0.03 * random_vector(random);
        Vector3d way_B = 0.04 * random_vector(random);
        if (i % 3 != 0) way_B[static_cast<Eigen::Index>(random() % 3)] = 0.0;
        if (i % 3 == 2) way_B[static_cast<Eigen::Index>(random() % 3)] = 0.0;
        const Vector3d way = box.pose.linear() * way_B;
        const auto hull_meets = [&](double by_m) {
            OrientedBox end = grown(box, by_m);
            auto corners = test::corners_of(end);
            end.pose.translation() += way;
            std::ranges::copy(test::corners_of(end), std::back_inserter(corners));
            return object.exact.meets_hull(corners);
        };
        const bool hit = hull_meets(-kBorderline_m);
        if (hit != hull_meets(kBorderline_m)) continue;
        ++(hit ? hits : free);
        ASSERT_EQ(object.tree.meets_box(box, way), hit) << i;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(free, 1000);
}

// Hulls of twelve points, each also scaled about its middle so that its faces move by more than the
// micrometre by which FCL errs.
TEST(GripperPosesOracle, ConvexBodiesAgreeWithTheExactHull) {
    constexpr double kScale = 2e-3;
    const Object object("cup", test::cup(0.04, 0.09, 0.006, 800));
    std::mt19937_64 random(14);
    int hits = 0, free = 0, skipped = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vector3d place = object.mesh.vertices[random() % object.mesh.vertices.size()] +
                               0.02 * random_vector(random);
        const Vector3d size = Vector3d::Constant(0.003) + 0.01 * random_vector(random).cwiseAbs();
        ConvexBody body;
        Vector3d middle = Vector3d::Zero();
        for (int k = 0; k < 12; ++k) {
            body.points_W.push_back(place + size.cwiseProduct(random_vector(random).normalized()));
            middle += body.points_W.back() / 12.0;
        }
        const auto hull_meets = [&](double scale) {
            std::vector<Vector3d> points;
            for (const Vector3d& p : body.points_W) points.push_back(middle + scale * (p - middle));
            return object.exact.meets_hull(points);
        };
        const bool hit = hull_meets(1.0 - kScale);
        if (hit != hull_meets(1.0 + kScale)) {
            ++skipped;
            continue;
        }
        const bool within = !hit && object.exact.contains(middle);
        ++(hit || within ? hits : free);
        ASSERT_EQ(find_collision(object.world, body).has_value(), hit || within) << i;
    }
    EXPECT_GT(hits, 800);
    EXPECT_GT(free, 800);
    EXPECT_LT(skipped, 100);
}

// FCL's narrow phase decides the same but for the micrometre by which it errs.
TEST(GripperPosesOracle, SeparatingAxesAgreeWithFcl) {
    const fcl::detail::GJKSolver_libccdd solver;
    std::mt19937_64 random(13);
    int hits = 0;
    for (int i = 0; i < 50000; ++i) {
        const Vector3d unit(fraction(random), fraction(random), fraction(random));
        const Vector3d half = Vector3d::Constant(0.001) + 0.03 * unit.cwiseProduct(unit);
        Corners t;
        const Vector3d middle = 0.04 * random_vector(random);
        const double size_m = std::pow(10.0, -1.0 - 3.0 * fraction(random));
        for (Vector3d& corner : t) corner = middle + size_m * random_vector(random);
        const auto ours = [&](double by_m) {
            return box_meets_triangle(half + Vector3d::Constant(by_m), Vector3d::Zero(), t);
        };
        const bool hit = ours(0.0);
        hits += hit;
        if (ours(-1e-6) != ours(1e-6)) continue;
        ASSERT_EQ(solver.shapeTriangleIntersect(fcl::Boxd(2.0 * half),
                                                Eigen::Isometry3d::Identity(), t[0], t[1], t[2]),
                  hit)
            << i;
    }
    EXPECT_GT(hits, 2000);
}

}  // namespace
}  // namespace graspd
