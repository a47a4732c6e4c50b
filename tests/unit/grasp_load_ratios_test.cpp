#include "graspd/grasp/load_ratios.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr LoadRatiosConfig kTask{.shake_m_s2 = 5.0, .torsion_length_m = 0.002};

/// Fingers 40 apart, patches of 20 x 40 with a mean radius of 10.
ContactPatches patches() {
    ContactPatches both;
    both.left = {Vector3d(-0.02, 0, 0), 0.01, 0.01, 0.02, 1.0};
    both.right = both.left;
    both.right.center_G.x() = 0.02;
    return both;
}

/// Half a kilogram 100 beyond the fingertips.
HeldLoad load(std::optional<Vector3d> down_G) {
    return {Vector3d(0, 0, 0.1), down_G, 0.5, 20.0, 0.6, 0.1};
}

// What friction carries: 2 x 20 x (0.6 - 0.1) = 20 N against 0.5 x 14.81. About Gx it carries
// 0.6 x 20 x (10 + 10 + 2 x 2) = 0.288 Nm; about Gy pressure and friction 20 x (20 + 20) + 0.6 x 20
// x 40 = 1.28 Nm.
constexpr double kTorsion_Nm = 0.288, kTiltY_Nm = 1.28;

// Hanging from the hand: gravity turns nothing, shaking 0.5 x 5 x 0.1 = 0.25 Nm.
TEST(LoadRatios, HangingBelowTheHandOnlyShakingTurnsIt) {
    const LoadRatios ratios = load_ratios(patches(), load(Vector3d(0, 0, 1)), kTask);
    EXPECT_NEAR(ratios.slip, 0.5 * 14.81 / 20.0, 1e-12);
    EXPECT_NEAR(ratios.torsion, 0.25 / kTorsion_Nm, 1e-12);
    EXPECT_NEAR(ratios.tilt, 0.25 / kTiltY_Nm, 1e-12);
}

// Held out sideways, gravity along Gy turns it about Gx; along Gx about Gy.
TEST(LoadRatios, HeldOutSidewaysGravityTurnsItToo) {
    const double both_Nm = 0.5 * (9.81 + 5.0) * 0.1;
    const LoadRatios along_y = load_ratios(patches(), load(Vector3d(0, -1, 0)), kTask);
    EXPECT_NEAR(along_y.torsion, both_Nm / kTorsion_Nm, 1e-12);
    EXPECT_NEAR(along_y.tilt, 0.25 / kTiltY_Nm, 1e-12);
    const LoadRatios along_x = load_ratios(patches(), load(Vector3d(1, 0, 0)), kTask);
    EXPECT_NEAR(along_x.torsion, 0.25 / kTorsion_Nm, 1e-12);
    EXPECT_NEAR(along_x.tilt, both_Nm / kTiltY_Nm, 1e-12);
}

// Where gravity's direction is not known the worst one counts for each axis.
TEST(LoadRatios, UnknownGravityIsTheWorst) {
    const double both_Nm = 0.5 * (9.81 + 5.0) * 0.1;
    const LoadRatios ratios = load_ratios(patches(), load(std::nullopt), kTask);
    EXPECT_NEAR(ratios.torsion, both_Nm / kTorsion_Nm, 1e-12);
    EXPECT_NEAR(ratios.tilt, both_Nm / kTiltY_Nm, 1e-12);
}

// A weight beside the fingers, along Gy, tilts about Gz: 20 x (10 + 10) + 0.48 = 0.88 Nm. The arm
// is measured from the middle between the patches, wherever the TCP is.
TEST(LoadRatios, ArmsBeginBetweenThePatches) {
    ContactPatches moved = patches();
    for (ContactPatch* patch : {&moved.left, &moved.right}) patch->center_G.z() = 0.1;
    HeldLoad beside = load(Vector3d(1, 0, 0));
    beside.center_of_mass_G = Vector3d(0, 0.03, 0.1);
    const LoadRatios ratios = load_ratios(moved, beside, kTask);
    EXPECT_NEAR(ratios.tilt, 0.5 * (9.81 + 5.0) * 0.03 / 0.88, 1e-12);
    EXPECT_NEAR(ratios.torsion, 0.5 * 5.0 * 0.03 / kTorsion_Nm, 1e-12);
}

TEST(LoadRatios, WithoutFrictionNothingIsCarried) {
    HeldLoad slippery = load(std::nullopt);
    slippery.min_friction = 0.6;
    EXPECT_TRUE(std::isinf(load_ratios(patches(), slippery, kTask).slip));
}

}  // namespace
}  // namespace graspd
