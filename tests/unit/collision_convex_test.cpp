// Lengths in the comments in mm.

#include "graspd/collision/convex_collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "graspd/collision/manipulability.hpp"
#include "support/collision_scene.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::from_above;
using test::parallel_85;
using Scene = test::CollisionScene;
using enum CollisionPartner;

constexpr double kSliver_m = 2e-6;  // FCL misses up to 6.5e-7 m of depth in some poses

/// An octahedron with its corners at 10 from the centre: its faces stand 10 / sqrt 3 from it.
ConvexBody octahedron(const Vector3d& center) {
    ConvexBody body;
    for (Eigen::Index k = 0; k < 3; ++k) {
        for (const double side : {-0.01, 0.01}) {
            body.points_W.push_back(center + side * Vector3d::Unit(k));
        }
    }
    return body;
}

/// A block 100 x 60 x 40, centred.
Scene block() {
    return Scene(test::box({0.10, 0.06, 0.04}, 300));
}
double distance_m(const Scene& scene, const ConvexBody& body) {
    return find_clearance(scene.world(), std::vector{body}, 1.0).distance_m;
}

// Its corner points at the block's side, its edge stands along the block's edge, its face before
// the block's corner.
TEST(ConvexBody, MeetsTheBlockWhenItsReachExceedsTheGap) {
    const Scene scene = block();
    const Vector3d level = Vector3d(1, 1, 0).normalized(),
                   diagonal = Vector3d(1, 1, 1).normalized();
    struct Row {
        Vector3d touch, away;
        double reach_m;
    };
    const Row rows[] = {{{0.05, 0.004, -0.003}, Vector3d::UnitX(), 0.01},
                        {{0.05, 0.03, 0.002}, level, 0.01 / std::sqrt(2.0)},
                        {{0.05, 0.03, 0.02}, diagonal, 0.01 / std::sqrt(3.0)}};
    for (const Row& row : rows) {
        const auto at = [&](double gap_m) {
            return octahedron(row.touch + (row.reach_m + gap_m) * row.away);
        };
        EXPECT_EQ(find_collision(scene.world(), at(kSliver_m)), std::nullopt) << row.reach_m;
        EXPECT_EQ(find_collision(scene.world(), at(-kSliver_m)), kObject) << row.reach_m;
        for (const double gap_m : {1e-5, 0.001, 0.0021, 0.009, 0.05}) {
            EXPECT_NEAR(distance_m(scene, at(gap_m)), gap_m, 1e-8) << row.reach_m;
        }
    }
}

// The box around the octahedron meets the block's corner, the octahedron does not.
TEST(ConvexBody, IsNotTheBoxAroundIt) {
    const ConvexBody body = octahedron({0.058, 0.038, 0.0});
    EXPECT_EQ(find_collision(block().world(), box_around(body)), kObject);
    EXPECT_EQ(find_collision(block().world(), body), std::nullopt);
}

TEST(ConvexBody, WhollyInsideIsNotFree) {
    EXPECT_EQ(find_collision(block().world(), octahedron({0.01, 0, 0})), kObject);
    const Scene small(test::box({0.002, 0.002, 0.002}));
    EXPECT_EQ(find_collision(small.world(), octahedron({0, 0, 0})), kObject);
}

TEST(ConvexBody, NamesThePartner) {
    const ConvexBody body = octahedron({0, 0, 0});
    EXPECT_EQ(find_collision(Scene().obstacle({0.01, 0.01, 0.01}, {0.014, 0, 0}).world(), body),
              kObstacle);
    EXPECT_EQ(find_collision(Scene().obstacle({0.01, 0.01, 0.01}, {0.016, 0, 0}).world(), body),
              std::nullopt);
    for (const double x_m : {0.0149, 0.0151, 0.018}) {
        Scene scene;
        scene.keep_out({0.005, 0.005, 0.005}, {x_m, 0, 0});
        EXPECT_EQ(find_collision(scene.world(), body).has_value(), x_m < 0.015);
        EXPECT_NEAR(distance_m(scene, body), std::max(0.0, x_m - 0.015), 1e-8);
    }
    for (const double offset_m : {-0.0099, -0.0101, -0.012}) {
        Scene scene;
        scene.plane({0, 0, 1}, offset_m);
        EXPECT_EQ(find_collision(scene.world(), body).has_value(), offset_m > -0.01);
        EXPECT_NEAR(distance_m(scene, body), std::max(0.0, -0.01 - offset_m), 1e-12);
    }
    EXPECT_EQ(find_collision(Scene().keep_out({0.005, 0.005, 0.005}, {0, 0, 0}).world(), body),
              kKeepOut);
    EXPECT_EQ(find_collision(Scene().plane({0, 0, 1}, 0.0).world(), body), kPlane);
    EXPECT_EQ(find_obstruction(block().world(), body), std::nullopt);  // the object does not count
}

// From x = -100 to 100 it passes over the block's top at z = 20 when it is higher than 30.
TEST(ConvexBody, WhatItPassesIsTheHullOfBothEnds) {
    const auto passing = [](double z_m) { return swept(octahedron({-0.1, 0, z_m}), {0.2, 0, 0}); };
    EXPECT_EQ(find_collision(block().world(), passing(0.0301)), std::nullopt);
    EXPECT_EQ(find_collision(block().world(), passing(0.0299)), kObject);
    EXPECT_NEAR(distance_m(block(), passing(0.034)), 0.004, 1e-8);
}

TEST(ConvexBody, GrowsByAtLeastTheDistance) {
    const ConvexBody body = grown(octahedron({0, 0, 0}), 0.001);
    double reach_m = 0.0;
    for (const Vector3d& p : body.points_W) reach_m = std::max(reach_m, p.x());
    EXPECT_NEAR(reach_m, 0.011, 1e-15);
}

/// A box's corners.
std::vector<Vector3d> corners(const Eigen::AlignedBox3d& box) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 8; ++i) {
        points.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    }
    return points;
}

/// parallel_85 with its boxes as convex parts, in H, whose z = 0 is the palm's rear.
Gripper of_parts() {
    Gripper gripper = parallel_85();
    const double tcp_z_H = pad_z_m(gripper, gripper.max_width_m);
    for (const GripperPart& part :
         gripper_parts(gripper, gripper.max_width_m, gripper.max_width_m)) {
        const auto member = static_cast<GripperMember>(gripper.convex_parts.size());
        gripper.convex_parts.push_back(
            {part.name, member, corners(part.box_G.translated(Vector3d(0, 0, tcp_z_H)))});
    }
    return gripper;
}

// Whatever the world holds, boxes and the same boxes as convex parts must come to the same verdict.
TEST(ConvexGripper, OfBoxesJudgesLikeTheBoxes) {
    std::mt19937_64 random(5);
    const auto draw = [&](double most) {
        return most * (2.0 * static_cast<double>(random() >> 11) * 0x1.0p-53 - 1.0);
    };
    const Gripper boxes = parallel_85(), parts = of_parts();
    int free = 0, blocked = 0;
    for (int i = 0; i < 400; ++i) {
        Scene scene(test::moved(test::cup(0.03, 0.06, 0.004, 600), test::random_pose(3)));
        scene.obstacle({0.05, 0.04, 0.03}, {0.1, draw(0.1), draw(0.1)})
            .plane({0, 0, 1}, -0.15)
            .keep_out({0.02, 0.03, 0.01}, {draw(0.1), 0.1, draw(0.1)});
        Eigen::Isometry3d X_WG = test::random_pose(static_cast<std::uint64_t>(100 + i));
        X_WG.translation() = Vector3d(draw(0.08), draw(0.08), draw(0.08));
        const double width_m = 0.04 + draw(0.03);
        const auto a = check_motion(scene.world(), boxes, X_WG, width_m, {});
        const auto b = check_motion(scene.world(), parts, X_WG, width_m, {});
        EXPECT_EQ(a.reason(), b.reason()) << i;
        EXPECT_EQ(check_retreat(scene.world(), boxes, X_WG, width_m, {}).reason(),
                  check_retreat(scene.world(), parts, X_WG, width_m, {}).reason())
            << i;
        ++(a.free() ? free : blocked);
        if (!a.free()) continue;
        const ApproachShape shape{width_m, a.open_width_m, 0.1};
        EXPECT_NEAR(approach_clearance(scene.world(), boxes, X_WG, shape, 0.05).distance_m,
                    approach_clearance(scene.world(), parts, X_WG, shape, 0.05).distance_m, 1e-7)
            << i;
    }
    EXPECT_GT(free, 20);
    EXPECT_GT(blocked, 20);
}

// Fingers with a bevelled outer side: 10 thick at the heel, 2 at the tip. Contact 40, open 45: the
// tip spans x from 22.5 to 24.5. An obstacle beside it at 26 to 30 is met by the box alone.
TEST(ConvexGripper, ABevelledFingerFitsWhereItsBoxDoesNot) {
    Gripper gripper = parallel_85();
    const double open = 0.5 * gripper.max_width_m;
    for (const double side : {-1.0, 1.0}) {
        ConvexPart part{
            "finger", side < 0.0 ? GripperMember::kFingerLeft : GripperMember::kFingerRight, {}};
        for (const double y : {-0.01, 0.01}) {
            part.points.emplace_back(side * open, y, 0.08);
            part.points.emplace_back(side * (open + 0.01), y, 0.08);
            part.points.emplace_back(side * open, y, 0.125);
            part.points.emplace_back(side * (open + 0.002), y, 0.125);
        }
        gripper.convex_parts.push_back(part);
    }
    ManipulabilityConfig one;
    one.preshape_margin_m = 0.0025;
    one.preshape_halvings = 0;
    Scene scene;
    scene.obstacle({0.004, 0.004, 0.002}, {0.028, 0, -0.009});
    EXPECT_EQ(check_motion(scene.world(), parallel_85(), from_above(0, 0), 0.04, one).reason(),
              "finger_hits_obstacle");
    EXPECT_EQ(check_motion(scene.world(), gripper, from_above(0, 0), 0.04, one).reason(), "free");
    // On its way down it passes nothing but that: the heel, 10 thick, stays 35 above.
    Scene higher;
    higher.obstacle({0.004, 0.004, 0.002}, {0.028, 0, 0.030});
    EXPECT_EQ(check_motion(higher.world(), gripper, from_above(0, 0), 0.04, one).reason(),
              "finger_hits_obstacle");
}

// The palm's parts reach 50 and 30 sideways; a finger's part 4 inside the pad's plane does not
// count for the box, 12 outside does. The pads keep 20 x 20.
TEST(FitBoxes, HoldAllPartsOutsideThePads) {
    Gripper gripper = parallel_85();
    const double open = 0.5 * gripper.max_width_m;
    using Box = Eigen::AlignedBox3d;
    gripper.convex_parts = {
        {"a", GripperMember::kPalm,
         corners(Box(Vector3d(-0.05, -0.01, -0.02), Vector3d(0.04, 0.03, 0.07)))},
        {"b", GripperMember::kFingerRight,
         corners(Box(Vector3d(open - 0.004, -0.015, 0.06), Vector3d(open + 0.012, 0.012, 0.13)))}};
    fit_boxes(gripper);
    EXPECT_NEAR(gripper.palm_width_m, 0.10, 1e-12);
    EXPECT_NEAR(gripper.palm_height_m, 0.06, 1e-12);
    EXPECT_NEAR(gripper.palm_z_m, -0.02, 1e-12);
    EXPECT_NEAR(gripper.palm_depth_m, 0.09, 1e-12);
    EXPECT_NEAR(gripper.finger_thickness_m, 0.012, 1e-12);
    EXPECT_NEAR(gripper.finger_width_m, 0.03, 1e-12);
    EXPECT_NEAR(gripper.tip_offset_m, 0.015, 1e-12);  // pads at 80 + 45 - 10 = 115, tip at 130
    EXPECT_NEAR(gripper.finger_length_m, 0.07, 1e-12);
    EXPECT_NEAR(pad_z_m(gripper, 0.03), 0.115, 1e-12);
    EXPECT_NEAR(pad_half_size_m(gripper).x(), 0.01, 1e-12);
    EXPECT_NEAR(pad_half_size_m(gripper).y(), 0.01, 1e-12);
    EXPECT_FALSE(validate(gripper));
}

}  // namespace
}  // namespace graspd
