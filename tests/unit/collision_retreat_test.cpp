// All lengths in the comments in mm; parallel_85 as in support/collision_scene.hpp.

#include <gtest/gtest.h>

#include <string>

#include "graspd/collision/manipulability.hpp"
#include "support/collision_scene.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::from_above;
using test::parallel_85;
using Scene = test::CollisionScene;

constexpr ManipulabilityConfig kConfig;  // way 100, of which the object may take 2 to come off

/// Contact 40, hand from above with its TCP at 0: closed fingers |x| from 20 to 30, |y| <= 10, z
/// from -10 to 35; palm |x| <= 60, |y| <= 20, z from 35 to 115. It retreats by 100.
std::string retreat_of(const Scene& scene, const ManipulabilityConfig& config = kConfig) {
    return check_retreat(scene.world(), parallel_85(), from_above(0, 0), 0.04, config).reason();
}

TEST(CheckRetreat, WithoutAPlaneTheHandGoesBackAsItCame) {
    const Vector3d half(0.005, 0.005, 0.005);
    EXPECT_EQ(retreat_of(Scene()), "free");
    EXPECT_EQ(retreat_of(Scene().keep_out(half, {0, 0, 0.215})), "retreat_hits_keep_out");
    EXPECT_EQ(retreat_of(Scene().keep_out(half, {0, 0, 0.221})), "free");
    EXPECT_EQ(retreat_of(Scene().obstacle(2 * half, {0.064, 0, 0.2})), "retreat_hits_obstacle");
    EXPECT_EQ(retreat_of(Scene().obstacle(2 * half, {0.066, 0, 0.2})), "free");
    ManipulabilityConfig near = kConfig;
    near.approach_distance_m = 0.09;
    EXPECT_EQ(retreat_of(Scene().keep_out(half, {0, 0, 0.215}), near), "free");
    const MotionCheck check = check_retreat(Scene().obstacle(2 * half, {0, 0, 0.1}).world(),
                                            parallel_85(), from_above(0, 0), 0.04, kConfig);
    EXPECT_EQ(check.block, MotionBlock::kRetreat);
    EXPECT_EQ(check.partner, CollisionPartner::kObstacle);
}

// A wall at x = -500 as the plane: the hand leaves along x. Its right finger passes x up to 130,
// its palm up to 160.
TEST(CheckRetreat, WithAPlaneTheHandGoesAlongItsNormal) {
    const auto reason = [](const Vector3d& center) {
        return retreat_of(Scene().plane({1, 0, 0}, -0.5).obstacle({0.004, 0.004, 0.004}, center));
    };
    EXPECT_EQ(reason({0.12, 0, 0}), "retreat_hits_obstacle");
    EXPECT_EQ(reason({0.133, 0, 0}), "free");
    EXPECT_EQ(reason({0.12, 0.013, 0}), "free");  // beside the finger, before the palm
    EXPECT_EQ(reason({0.155, 0, 0.05}), "retreat_hits_obstacle");
    EXPECT_EQ(reason({0.163, 0, 0.05}), "free");
    EXPECT_EQ(reason({0, 0, 0.150}), "free");  // where it would go without the plane
    EXPECT_EQ(reason({0, 0, 0.110}), "retreat_hits_obstacle");  // in the palm already
    EXPECT_EQ(retreat_of(Scene().plane({0, 0, 1}, -0.009)), "retreat_hits_plane");
}

// Leaving along (1, 0, 1), by 70.7 each way, the hand passes a slanted prism: at x = 95 the
// finger's lower side is at z = -10 + 95 - 30 = 55, the box around its way begins at -10.
TEST(CheckRetreat, ASlantedWayIsNoBox) {
    const Vector3d normal = Vector3d(1, 0, 1).normalized();
    const auto reason = [&](double z_m) {
        const Vector3d center(0.095, 0, z_m);
        return retreat_of(Scene().plane(normal, -0.5).obstacle({0.002, 0.002, 0.002}, center)) +
               " " + retreat_of(Scene().plane(normal, -0.5).keep_out({1e-3, 1e-3, 1e-3}, center));
    };
    EXPECT_EQ(reason(0.0), "free free");
    EXPECT_EQ(reason(0.052), "free free");  // its upper left corner at 94, 53: the side is at 54
    EXPECT_EQ(reason(0.060), "retreat_hits_obstacle retreat_hits_keep_out");
}

/// A block 40 wide (x), 60 long (y), 60 high, its top at z = 0, in the hand. The hand has |y|
/// <= 20.
Scene held_block() {
    return Scene(test::moved(test::box({0.04, 0.06, 0.06}),
                             Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.03))));
}

TEST(CheckRetreat, WhatTheHandHoldsMustPassToo) {
    const auto reason = [](const Vector3d& center) {
        return retreat_of(held_block().obstacle({0.004, 0.004, 0.004}, center));
    };
    EXPECT_EQ(reason({0, 0.028, 0.03}), "retreat_hits_obstacle");
    EXPECT_EQ(reason({0, 0.031, 0.03}), "retreat_hits_obstacle");
    EXPECT_EQ(reason({0, 0.0325, 0.03}), "free");  // beside its way, from 30.5
    EXPECT_EQ(reason({0, 0.028, 0.101}), "retreat_hits_obstacle");
    EXPECT_EQ(reason({0, 0.028, 0.1025}), "free");                 // above its way, from 100.5
    EXPECT_EQ(reason({0, 0.028, -0.0625}), "free");                // below it
    EXPECT_EQ(reason({0, 0.02, -0.03}), "retreat_hits_obstacle");  // within it
    // A frame around it that touches nothing of it on its way.
    const auto frame = [](double y_m) {
        return retreat_of(held_block()
                              .obstacle({0.2, 0.01, 0.01}, {0, y_m, 0.05})
                              .obstacle({0.2, 0.01, 0.01}, {0, -y_m, 0.05}));
    };
    EXPECT_EQ(frame(0.0355), "free");
    EXPECT_EQ(frame(0.0345), "retreat_hits_obstacle");
}

// Leaving along (1, 0, 1) the block's lower edge runs from x = 20, z = -60: at x = 58 to -22.
TEST(CheckRetreat, TheSlantedWayOfTheObjectIsNoBox) {
    const auto reason = [](double z_m) {
        return retreat_of(held_block()
                              .plane(Vector3d(1, 0, 1).normalized(), -0.5)
                              .obstacle({0.004, 0.004, 0.004}, {0.060, 0.025, z_m}));
    };
    EXPECT_EQ(reason(-0.0245), "free");
    EXPECT_EQ(reason(-0.0200), "retreat_hits_obstacle");
}

// The block stands on a table that is 1 too high, or 3: the first 2 of its way do not count.
TEST(CheckRetreat, TheObjectMayComeOffWhatItTouches) {
    const auto on_table = [](double top_m, double release_m) {
        ManipulabilityConfig config = kConfig;
        config.release_m = release_m;
        return retreat_of(held_block().obstacle({0.5, 0.5, 0.01}, {0, 0, top_m - 0.005}), config);
    };
    EXPECT_EQ(on_table(-0.060, kConfig.release_m), "free");
    EXPECT_EQ(on_table(-0.059, kConfig.release_m), "free");
    EXPECT_EQ(on_table(-0.057, kConfig.release_m), "retreat_hits_obstacle");
    EXPECT_EQ(on_table(-0.057, 0.004), "free");
}

}  // namespace
}  // namespace graspd
