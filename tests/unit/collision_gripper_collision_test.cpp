#include "graspd/collision/gripper_collision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using enum CollisionPartner;

constexpr double kPi = std::numbers::pi;
constexpr double kSliver_m = 2e-6;  // FCL misses up to 6.5e-7 m of depth in some poses

/// A mesh with its tree.
struct Solid {
    explicit Solid(TriangleMesh m) : mesh(std::move(m)), tree(mesh, 1e-7) {}
    CollisionBody body() const { return {&mesh, &tree}; }
    TriangleMesh mesh;
    TriangleBvh tree;
};

/// A block of 100 x 60 x 40, centred.
const Solid& block() {
    static const Solid solid(test::box({0.10, 0.06, 0.04}, 300));
    return solid;
}
/// Far away, for tests in which the object plays no part.
const Solid& remote() {
    static const Solid solid(test::moved(test::box({0.01, 0.01, 0.01}),
                                         Eigen::Isometry3d(Eigen::Translation3d(5.0, 5.0, 5.0))));
    return solid;
}

CollisionWorld world_of(const Solid& object) {
    CollisionWorld world;
    world.object = object.body();
    return world;
}

OrientedBox box_at(const Vector3d& center, const Vector3d& half,
                   const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
    OrientedBox box;
    box.pose.linear() = turn;
    box.pose.translation() = center;
    box.half_extent = half;
    return box;
}
Eigen::Matrix3d turned(double angle_rad, const Vector3d& axis) {
    return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}
/// The turn that lays `from` along `to`.
Eigen::Matrix3d laid(const Vector3d& from, const Vector3d& to) {
    return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

double distance_m(const CollisionWorld& world, const OrientedBox& box, double most_m = 1.0) {
    return find_clearance(world, std::vector{box}, most_m).distance_m;
}

/// A box and the distance by which it stands off the block, for ways of facing it that are worked
/// out by hand. A cube of half side h reaches h, h sqrt 2 and h sqrt 3 towards face, edge and
/// corner.
struct Facing {
    const char* name;
    Vector3d touch;  ///< where both meet when the gap is 0
    Vector3d away;   ///< unit, from the block to the box
    double reach_m;  ///< from the box's centre to `touch` then
    Eigen::Matrix3d turn;
};
std::vector<Facing> facings() {
    constexpr double kHalf = 0.01;
    const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
    const Vector3d diagonal = Vector3d(1, 1, 1).normalized();
    const Vector3d level = Vector3d(1, 1, 0).normalized();
    const Vector3d on_face(0.05, 0.004, -0.003), on_edge(0.05, 0.03, 0.002);
    const Vector3d corner(0.05, 0.03, 0.02);
    Eigen::Matrix3d crossed;  // an edge of the cube crosses the block's upright edge at 90 degrees
    crossed.col(0) = Vector3d(1, -1, 0).normalized();
    crossed.col(1) = (level + z).normalized();
    crossed.col(2) = crossed.col(0).cross(crossed.col(1));
    return {
        {"face to face", on_face, x, kHalf, Eigen::Matrix3d::Identity()},
        {"edge to face", on_face, x, kHalf * std::sqrt(2.0), turned(kPi / 4, z)},
        {"corner to face", on_face, x, kHalf * std::sqrt(3.0), laid(diagonal, -x)},
        {"face to edge", on_edge, level, kHalf, turned(kPi / 4, z)},
        {"edge across edge", on_edge, level, kHalf * std::sqrt(2.0), crossed},
        {"corner to edge", on_edge, level, kHalf * std::sqrt(3.0), laid(diagonal, -level)},
        {"face to corner", corner, diagonal, kHalf, laid(x, diagonal)},
        {"corner to corner", corner, diagonal, kHalf * std::sqrt(3.0), laid(diagonal, -diagonal)},
    };
}
OrientedBox faced(const Facing& facing, double gap_m) {
    return box_at(facing.touch + (facing.reach_m + gap_m) * facing.away, Vector3d::Constant(0.01),
                  facing.turn);
}

TEST(FindCollision, ABoxThatFacesTheBlockHitsItWhenItsReachExceedsTheGap) {
    const CollisionWorld world = world_of(block());
    for (const Facing& facing : facings()) {
        EXPECT_EQ(find_collision(world, faced(facing, kSliver_m)), std::nullopt) << facing.name;
        EXPECT_EQ(find_collision(world, faced(facing, -kSliver_m)), kObject) << facing.name;
        EXPECT_EQ(find_collision(world, faced(facing, -0.005)), kObject) << facing.name;
    }
}

TEST(FindCollision, WhatLiesWhollyInsideIsNotFree) {
    const CollisionWorld world = world_of(block());
    EXPECT_EQ(find_collision(world, box_at({0.01, 0.005, 0.003}, Vector3d::Constant(0.004))),
              kObject);
    // And the other way round: the whole block in a box that touches none of its faces.
    EXPECT_EQ(find_collision(world, box_at({0, 0, 0}, {0.06, 0.04, 0.03})), kObject);
}

// The cup's inside, 72 wide and 86 deep, and the torus's hole, 80 wide, are no part of the solid.
TEST(FindCollision, CavitiesAreFree) {
    const Solid cup(test::cup(0.04, 0.09, 0.004, 2000));
    EXPECT_EQ(find_collision(world_of(cup), box_at({0, 0, 0.05}, {0.02, 0.02, 0.03})),
              std::nullopt);
    EXPECT_EQ(find_collision(world_of(cup), box_at({0, 0, 0.002}, {0.02, 0.02, 0.001})), kObject);
    const Solid torus(test::torus(0.06, 0.02, 2000));
    EXPECT_EQ(find_collision(world_of(torus), box_at({0, 0, 0}, {0.02, 0.02, 0.05})), std::nullopt);
    EXPECT_EQ(find_collision(world_of(torus), box_at({0.06, 0, 0}, Vector3d::Constant(0.004))),
              kObject);
}

// An object of two parts, one of them wholly inside the box.
TEST(FindCollision, APartWhollyInsideTheBoxIsHit) {
    Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
    aside.translation() << 0.2, 0, 0;
    const Solid two(
        test::joined(test::box({0.10, 0.06, 0.04}), test::moved(test::sphere(0.005, 200), aside)));
    EXPECT_EQ(find_collision(world_of(two), box_at({0.2, 0, 0}, Vector3d::Constant(0.02))),
              kObject);
    EXPECT_EQ(find_collision(world_of(two), box_at({0.15, 0, 0}, Vector3d::Constant(0.02))),
              std::nullopt);
}

TEST(FindCollision, NamesThePartnersInTheirOrder) {
    const Solid obstacle(test::box({0.02, 0.02, 0.02}));
    const OrientedBox box = box_at({0, 0, 0}, {0.005, 0.005, 0.03});
    CollisionWorld world = world_of(block());
    world.obstacles = {remote().body(), obstacle.body()};
    world.plane = HalfSpace{Vector3d::UnitZ(), -0.02};
    world.keep_out = {box_at({3, 3, 3}, Vector3d::Constant(0.1)),
                      box_at({0, 0, 0}, Vector3d::Constant(0.01))};
    EXPECT_EQ(find_collision(world, box), kObject);
    world.object = remote().body();
    EXPECT_EQ(find_collision(world, box), kObstacle);
    world.obstacles.pop_back();
    EXPECT_EQ(find_collision(world, box), kPlane);
    world.plane.reset();
    EXPECT_EQ(find_collision(world, box), kKeepOut);
    world.keep_out.pop_back();
    EXPECT_EQ(find_collision(world, box), std::nullopt);
}

// Half sides 30, 40, 10; turned 90 degrees about y the first stands upright, turned 45 degrees it
// and the third reach (30 + 10) / sqrt 2 down. The plane leans: height is measured along its
// normal.
TEST(FindCollision, TheLowestCornerDecidesAboutThePlane) {
    const Vector3d half(0.03, 0.04, 0.01);
    struct Row {
        Eigen::Matrix3d turn;
        double reach_m;
    };
    const Vector3d y = Vector3d::UnitY();
    const Row rows[] = {{Eigen::Matrix3d::Identity(), 0.01},
                        {turned(kPi / 2, y), 0.03},
                        {turned(kPi / 4, y), 0.04 / std::sqrt(2.0)}};
    const Eigen::Matrix3d lean = turned(0.4, Vector3d::UnitX());
    for (const Row& row : rows) {
        for (const Eigen::Matrix3d& frame : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), lean}) {
            CollisionWorld world = world_of(remote());
            const Vector3d normal = frame.col(2);
            world.plane = HalfSpace{normal, 0.2};
            const auto box = [&](double height_m) {
                return box_at(normal * (0.2 + row.reach_m + height_m), half, frame * row.turn);
            };
            EXPECT_EQ(find_collision(world, box(1e-9)), std::nullopt);
            EXPECT_EQ(find_collision(world, box(-1e-9)), kPlane);
            EXPECT_EQ(find_collision(world, box(-1.0)), kPlane);
            EXPECT_NEAR(distance_m(world, box(0.017)), 0.017, 1e-12);
        }
    }
}

TEST(FindCollision, KeepOutBoxesAreSolid) {
    const Vector3d center(0.1, 0.2, 0.3);
    const Eigen::Matrix3d turn = turned(0.7, Vector3d(1, 2, 3).normalized());
    CollisionWorld world = world_of(remote());
    world.keep_out = {box_at(center, {0.05, 0.03, 0.02}, turn)};
    const auto at = [&](const Vector3d& place, double half) {
        return box_at(center + turn * place, Vector3d::Constant(half), turn);
    };
    EXPECT_EQ(find_collision(world, at({0, 0, 0}, 0.001)), kKeepOut);  // inside
    EXPECT_EQ(find_collision(world, at({0, 0, 0}, 0.2)), kKeepOut);    // around
    EXPECT_EQ(find_collision(world, at({0.06 - kSliver_m, 0, 0}, 0.01)), kKeepOut);
    EXPECT_EQ(find_collision(world, at({0.06 + kSliver_m, 0, 0}, 0.01)), std::nullopt);
    // Past the edge the axes of both boxes separate only in the sum of both directions.
    const OrientedBox beside = box_at(center + turn * Vector3d(0.05, 0.03, 0) +
                                          turn * Vector3d(1, 1, 0).normalized() * (0.01 + 1e-5),
                                      Vector3d::Constant(0.01), turn * turned(kPi / 4, {0, 0, 1}));
    EXPECT_EQ(find_collision(world, beside), std::nullopt);
}

TEST(FindClearance, IsTheGapOfEveryFacing) {
    const CollisionWorld world = world_of(block());
    for (const Facing& facing : facings()) {
        for (const double gap_m : {2e-5, 1e-3, 1.9e-3, 2.1e-3, 7.9e-3, 8.1e-3, 0.031, 0.033}) {
            EXPECT_NEAR(distance_m(world, faced(facing, gap_m)), gap_m, 1e-8)
                << facing.name << " " << gap_m;
        }
    }
}

// Parallel boxes 3 and 4 beyond an edge are 5 apart, 3, 4 and 12 beyond a corner 13.
TEST(FindClearance, AddsTheOffsetsBeyondEdgeAndCorner) {
    const CollisionWorld world = world_of(block());
    const Vector3d half = Vector3d::Constant(0.01);
    EXPECT_NEAR(distance_m(world, box_at({0.063, 0.044, 0.0}, half)), 0.005, 1e-8);
    EXPECT_NEAR(distance_m(world, box_at({-0.063, 0.044, -0.042}, half)), 0.013, 1e-8);
}

TEST(FindClearance, IsCappedByTheGreatestAskedFor) {
    const CollisionWorld world = world_of(block());
    const OrientedBox box = box_at({0.063, 0.044, 0.042}, Vector3d::Constant(0.01));
    EXPECT_DOUBLE_EQ(distance_m(world, box, 0.010), 0.010);
    EXPECT_DOUBLE_EQ(distance_m(world, box, 0.001), 0.001);
    EXPECT_NEAR(distance_m(world, box, 0.014), 0.013, 1e-8);
    EXPECT_DOUBLE_EQ(distance_m(world_of(remote()), box, 0.05), 0.05);
}

// The block is 9 from the first box, 6 from the second. Nearer partners follow, each in turn.
TEST(FindClearance, NamesTheNearestBoxAndPartner) {
    const Vector3d half = Vector3d::Constant(0.01);
    const std::vector<OrientedBox> boxes = {box_at({0.069, 0, 0}, half),
                                            box_at({0, 0.046, 0}, half)};
    CollisionWorld world = world_of(block());
    const auto expect = [&](double gap_m, std::size_t box, CollisionPartner partner) {
        const Clearance clearance = find_clearance(world, boxes, 1.0);
        EXPECT_NEAR(clearance.distance_m, gap_m, 1e-8) << to_string(partner);
        EXPECT_EQ(clearance.box, box) << to_string(partner);
        EXPECT_EQ(clearance.partner, partner);
    };
    expect(0.006, 1, kObject);
    const Solid obstacle(test::moved(test::box({0.01, 0.01, 0.01}),
                                     Eigen::Isometry3d(Eigen::Translation3d(0.089, 0, 0))));
    world.obstacles = {remote().body(), obstacle.body()};  // from 84; the first box ends at 79
    expect(0.005, 0, kObstacle);
    world.keep_out = {box_at({0, 0.07, 0}, half)};  // from 60; the second box ends at 56
    expect(0.004, 1, kKeepOut);
    world.plane = HalfSpace{Vector3d::UnitZ(), -0.013};
    expect(0.003, 0, kPlane);  // both boxes alike: the first one counts
}

TEST(CollisionPartner, HasTheNamesOfTheReport) {
    EXPECT_STREQ(to_string(kObject), "object");
    EXPECT_STREQ(to_string(kObstacle), "obstacle");
    EXPECT_STREQ(to_string(kPlane), "plane");
    EXPECT_STREQ(to_string(kKeepOut), "keep_out");
}

}  // namespace
}  // namespace graspd
