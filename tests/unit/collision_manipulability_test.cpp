// All lengths in the comments in mm. parallel_85 about its TCP: pads' gap along x, fingers 10
// thick, 20 wide (|y| <= 10), from z = -35 to the tip at 10; palm |x| <= 60, |y| <= 20, z from -115
// to -35.

#include "graspd/collision/manipulability.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "support/collision_scene.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::from_above;
using test::parallel_85;
using Scene = test::CollisionScene;

constexpr ManipulabilityConfig kConfig;  // margins 10, 5, 2.5; approach 100; tolerance 0.5

/// Opening and pads as in profiles/grippers/robotiq_2f_85.yaml; the rest plain.
Gripper linkage() {
    Gripper gripper;
    gripper.tip_offset_m = 0.01875;
    gripper.pad_travel = {{0.0453, 0.14165}, {0.0584, 0.13915}, {0.0664, 0.13705}};
    return gripper;
}

/// U channel with walls 10 thick; the right wall's middle stands at x = gap / 2 + 5.
Scene channel(double depth_m, double gap_m) {
    return Scene(test::u_channel(depth_m, gap_m, 0.01, 0.08, 400));
}
MotionCheck across_wall(double depth_m, double gap_m, double tcp_z_m) {
    return channel(depth_m, gap_m).check(from_above(0.5 * gap_m + 0.005, tcp_z_m), 0.01);
}

// The inner finger spans margin to margin + 10 beside the wall: 20 fit a gap of 21, not of 19; then
// 15, and 12.5 at the last.
TEST(CheckMotion, TakesTheWidestPreshapeThatFitsTheGap) {
    struct Row {
        double gap_m, open_width_m;
        bool free;
    };
    const Row rows[] = {{0.021, 0.030, true},  {0.019, 0.020, true},  {0.0151, 0.020, true},
                        {0.0149, 0.015, true}, {0.0126, 0.015, true}, {0.0124, 0.015, false}};
    for (const Row& row : rows) {
        const MotionCheck check = across_wall(0.03, row.gap_m, 0.02);
        EXPECT_EQ(check.free(), row.free) << row.gap_m;
        EXPECT_NEAR(check.open_width_m, row.open_width_m, 1e-12) << row.gap_m;
        EXPECT_EQ(check.reason(), row.free ? "free" : "finger_hits_object") << row.gap_m;
    }
}

// The tip stands 10 below the TCP: at 11 it is above the channel's floor, at 9 below.
TEST(CheckMotion, TheFingerMustNotReachTheFloor) {
    EXPECT_EQ(across_wall(0.03, 0.03, 0.011).reason(), "free");
    const MotionCheck check = across_wall(0.03, 0.03, 0.009);
    EXPECT_EQ(check.reason(), "finger_hits_object");
    EXPECT_EQ(check.block, MotionBlock::kFinger);
    EXPECT_EQ(check.partner, CollisionPartner::kObject);
}

// The palm's front stands 35 above the TCP. With the TCP at 20 it clears a wall of 54, not of 56.
TEST(CheckMotion, ThePalmMustNotReachTheTop) {
    EXPECT_EQ(across_wall(0.054, 0.03, 0.02).reason(), "free");
    const MotionCheck check = across_wall(0.056, 0.03, 0.02);
    EXPECT_EQ(check.reason(), "palm_hits_object");
    EXPECT_EQ(check.block, MotionBlock::kPalm);
}

// A block 40 wide, its top at 0; TCP 15 below it. A keep-out box 150 above the TCP is behind the
// palm (which ends at 115) and in its way (which begins at 215); one at 230 is in nobody's way. The
// fingers sweep up to 135 with |y| <= 10, beside and before the palm's box.
TEST(CheckMotion, TheWayOfThePalmMustBeFree) {
    const Eigen::Isometry3d X_WG = from_above(0.0, -0.015);
    const auto block = [] {
        return Scene(test::moved(test::box({0.04, 0.06, 0.06}),
                                 Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.03))));
    };
    const Vector3d half(0.005, 0.005, 0.005);
    EXPECT_EQ(block().check(X_WG, 0.04).reason(), "free");
    EXPECT_NEAR(block().check(X_WG, 0.04).open_width_m, 0.06, 1e-12);
    const MotionCheck check = block().keep_out(half, {0, 0, -0.015 + 0.150}).check(X_WG, 0.04);
    EXPECT_EQ(check.reason(), "approach_hits_keep_out");
    EXPECT_EQ(check.block, MotionBlock::kApproach);
    EXPECT_EQ(block().keep_out(half, {0, 0, -0.015 + 0.230}).check(X_WG, 0.04).reason(), "free");
    EXPECT_EQ(block().keep_out(half, {0, 0.026, -0.015 + 0.150}).check(X_WG, 0.04).reason(),
              "free");  // beside the palm: |y| from 21
    ManipulabilityConfig near = kConfig;
    near.approach_distance_m = 0.02;  // up to 135 only
    EXPECT_EQ(block()
                  .keep_out(half, {0, 0, -0.015 + 0.150})
                  .check(X_WG, 0.04, parallel_85(), near)
                  .reason(),
              "free");
}

// What an obstacle does depends on where it stands beside the right contact at x = 20. From 1 to 2
// it is in the way of every closing finger; from 3 to 4 a finger that is open by 2.5 stands in it;
// from 20.5 on it stands beside the widest open finger, which spans 10 to 20.
TEST(CheckMotion, TheWayOfTheClosingFingersMustBeFree) {
    const Eigen::Isometry3d X_WG = from_above(0.0, 0.0);
    const auto post = [&](double from_m, double to_m) {
        return Scene()
            .obstacle({to_m - from_m, 0.004, 0.004}, {0.02 + 0.5 * (from_m + to_m), 0, 0})
            .check(X_WG, 0.04);
    };
    const MotionCheck closing = post(0.001, 0.002);
    EXPECT_EQ(closing.reason(), "closing_hits_obstacle");
    EXPECT_EQ(closing.block, MotionBlock::kClosing);
    EXPECT_EQ(closing.partner, CollisionPartner::kObstacle);
    EXPECT_NEAR(closing.open_width_m, 0.045, 1e-12);
    EXPECT_EQ(post(0.003, 0.004).reason(), "finger_hits_obstacle");
    EXPECT_EQ(post(0.0205, 0.030).reason(), "free");
    // Within the tolerance before the contact nothing is looked at: the object itself is there.
    EXPECT_EQ(post(0.0, 0.0004).reason(), "free");
}

// Fingers sweep where the palm does not: |x| beyond 60 when open by more than 100.
TEST(CheckMotion, TheWayOfAFingerMustBeFree) {
    Gripper wide = parallel_85();
    wide.max_width_m = 0.2;  // contact 140, open 160: fingers from 80 to 90
    const MotionCheck check = Scene()
                                  .obstacle({0.004, 0.004, 0.004}, {0.085, 0, 0.06})
                                  .check(from_above(0, 0), 0.14, wide);
    // Behind the heel, at 35; margins of 5 and 2.5 put the finger at 75..85 and 72.5..82.5: from
    // 82.5 on the way is free, as the post begins at 83.
    EXPECT_EQ(check.reason(), "free");
    EXPECT_NEAR(check.open_width_m, 0.145, 1e-12);
    const MotionCheck all = Scene()
                                .obstacle({0.02, 0.004, 0.004}, {0.085, 0, 0.06})
                                .check(from_above(0, 0), 0.14, wide);
    EXPECT_EQ(all.reason(), "approach_hits_obstacle");
}

// Contact 83 and the least margin 2.5 on both sides need 88: 3 more than 85. At 79.9 the margins of
// 10 and 5 are cut to what the opening leaves.
TEST(CheckMotion, TooWideTellsByHowMuch) {
    const MotionCheck check = Scene().check(from_above(0, 0), 0.083);
    EXPECT_EQ(check.reason(), "too_wide");
    EXPECT_EQ(check.block, MotionBlock::kTooWide);
    EXPECT_NEAR(check.lacking_m, 0.003, 1e-12);
    const MotionCheck fits = Scene().check(from_above(0, 0), 0.0799);
    EXPECT_TRUE(fits.free());
    EXPECT_DOUBLE_EQ(fits.open_width_m, 0.085);

    ManipulabilityConfig one = kConfig;
    one.preshape_halvings = 0;  // the margin is 10 or nothing: 70 + 20 = 85 + 5
    EXPECT_NEAR(Scene().check(from_above(0, 0), 0.07, parallel_85(), one).lacking_m, 0.005, 1e-12);
    one.preshape_margin_m = 1e-4;  // below the closing tolerance of 0.5, which then is the margin
    EXPECT_NEAR(Scene().check(from_above(0, 0), 0.0845, parallel_85(), one).lacking_m, 0.0005,
                1e-12);
    EXPECT_NEAR(Scene().check(from_above(0, 0), 0.04, parallel_85(), one).open_width_m, 0.041,
                1e-12);
}

// check_pose looks at the narrowest pre-shape, 2.5 beside each contact, and at nothing that moves.
TEST(CheckPose, AsksAboutTheGraspPoseAlone) {
    EXPECT_DOUBLE_EQ(least_preshape_margin_m(kConfig), 0.0025);
    ManipulabilityConfig fine = kConfig;
    fine.preshape_halvings = 10;
    EXPECT_DOUBLE_EQ(least_preshape_margin_m(fine), 0.0005);  // the closing tolerance

    const auto reason = [](const Scene& scene, const Eigen::Isometry3d& X_WG, double width_m) {
        return check_pose(scene.world(), parallel_85(), X_WG, width_m, kConfig).reason();
    };
    const auto wall = [&](double depth_m, double gap_m, double tcp_z_m) {
        return reason(channel(depth_m, gap_m), from_above(0.5 * gap_m + 0.005, tcp_z_m), 0.01);
    };
    EXPECT_EQ(wall(0.03, 0.0126, 0.02), "free");
    EXPECT_EQ(wall(0.03, 0.0124, 0.02), "finger_hits_object");
    EXPECT_EQ(wall(0.03, 0.03, 0.009), "finger_hits_object");
    EXPECT_EQ(wall(0.056, 0.03, 0.02), "palm_hits_object");
    const Eigen::Isometry3d X_WG = from_above(0, 0);
    EXPECT_EQ(reason(Scene(), X_WG, 0.083), "too_wide");
    // In the way of the closing finger, and of the palm on its way: not asked here.
    EXPECT_EQ(reason(Scene().obstacle({0.001, 0.004, 0.004}, {0.0215, 0, 0}), X_WG, 0.04), "free");
    EXPECT_EQ(reason(Scene().keep_out({0.005, 0.005, 0.005}, {0, 0, 0.15}), X_WG, 0.04), "free");
}

// The object hangs below: what the hand does about a plane under its tips and behind its palm.
TEST(CheckMotion, APlaneBlocksLikeAnythingElse) {
    const Eigen::Isometry3d X_WG = from_above(0.0, 0.0);
    EXPECT_EQ(Scene().plane({0, 0, 1}, -0.0101).check(X_WG, 0.04).reason(), "free");
    EXPECT_EQ(Scene().plane({0, 0, 1}, -0.0099).check(X_WG, 0.04).reason(), "finger_hits_plane");
    // A ceiling, object below: behind the palm's rear at 115, then before the end of its way.
    EXPECT_EQ(Scene().plane({0, 0, -1}, -0.114).check(X_WG, 0.04).reason(), "palm_hits_plane");
    EXPECT_EQ(Scene().plane({0, 0, -1}, -0.116).check(X_WG, 0.04).reason(), "approach_hits_plane");
    EXPECT_EQ(Scene().plane({0, 0, -1}, -0.2151).check(X_WG, 0.04).reason(), "free");
}

// Contact 45.3: pads 141.65 before the flange. Open by 20 more, between the rows 58.4 and 66.4,
// they stand at 139.15 - 2.1 x 6.9 / 8 = 137.339, so the tips are 18.75 - 4.311 = 14.439 beyond the
// TCP, and 18.75 when closed. A plane at 16 is met only by closing fingers, one at 14 already by
// the open ones, one at 19 by none.
TEST(CheckMotion, LinkageFingersComeForwardWhileTheyClose) {
    ManipulabilityConfig one = kConfig;
    one.preshape_halvings = 0;
    const auto reason = [&](double beyond_m) {
        return Scene()
            .plane({0, 0, 1}, -beyond_m)
            .check(from_above(0, 0), 0.0453, linkage(), one)
            .reason();
    };
    EXPECT_EQ(reason(0.019), "free");
    EXPECT_EQ(reason(0.016), "closing_hits_plane");
    EXPECT_EQ(reason(0.01445), "closing_hits_plane");
    EXPECT_EQ(reason(0.01443), "finger_hits_plane");
}

// Open by 20 more than the contact the right finger begins at x = 32.65 with its tip at 14.4; at
// the row 58.4 it begins at 29.2 with the tip at 18.75 - 2.5 = 16.25, and it ends at 23.15
// and 18.56. A post from 17 to 19 is met by what stands over x = 35 (tip 17.9 when the outer side
// is there), not over 38 (16.7). The box around both ends, up to 18.56 for x up to 42.65, meets it
// there as well.
TEST(CheckMotion, LinkageFingersPassNoMoreThanTheirWay) {
    ManipulabilityConfig one = kConfig;
    one.preshape_halvings = 0;
    const auto reason = [&](double x_m) {
        return Scene()
            .obstacle({0.002, 0.004, 0.002}, {x_m, 0, 0.018})
            .check(Eigen::Isometry3d::Identity(), 0.0453, linkage(), one)
            .reason();
    };
    EXPECT_EQ(reason(0.025), "closing_hits_obstacle");
    EXPECT_EQ(reason(0.034), "closing_hits_obstacle");
    EXPECT_EQ(reason(0.039), "free");
}

TEST(SweptApproach, SpansFromPreGraspToGrasp) {
    Eigen::Isometry3d X_WG = test::random_pose(4);
    const auto boxes = swept_approach(parallel_85(), X_WG, 0.03, 0.05, 0.10);
    // Palm z from -215 to -35; fingers z from -135 to 10, |x| from 25 to 35.
    const std::vector<std::pair<Vector3d, Vector3d>> expected = {
        {{0, 0, -0.125}, {0.06, 0.02, 0.09}},
        {{-0.03, 0, -0.0625}, {0.005, 0.01, 0.0725}},
        {{0.03, 0, -0.0625}, {0.005, 0.01, 0.0725}}};
    ASSERT_EQ(boxes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT((boxes[i].pose.translation() - X_WG * expected[i].first).norm(), 1e-12) << i;
        EXPECT_LT((boxes[i].half_extent - expected[i].second).norm(), 1e-12) << i;
        EXPECT_LT((boxes[i].pose.linear() - X_WG.linear()).norm(), 1e-12) << i;
    }
}

// As above: open by 65.3 the linkage's tips stand 14.439 beyond the TCP; its palm, 80 deep, ends
// 141.65 - 80 behind it.
TEST(SweptApproach, FollowsThePadsTravel) {
    const auto boxes =
        swept_approach(linkage(), Eigen::Isometry3d::Identity(), 0.0453, 0.0653, 0.1);
    const auto top = [&](std::size_t i) {
        return boxes[i].pose.translation().z() + boxes[i].half_extent.z();
    };
    const auto bottom = [&](std::size_t i) {
        return boxes[i].pose.translation().z() - boxes[i].half_extent.z();
    };
    EXPECT_NEAR(top(0), -0.06165, 1e-12);
    EXPECT_NEAR(bottom(0), -0.24165, 1e-12);
    for (const std::size_t finger : {1, 2}) {
        EXPECT_NEAR(top(finger), 0.01443875, 1e-12);
        EXPECT_NEAR(bottom(finger), 0.01443875 - 0.045 - 0.1, 1e-12);
    }
}

}  // namespace
}  // namespace graspd
