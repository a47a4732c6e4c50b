#include "graspd/grasp/contact_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

// 5 x 9 cells of 4 x 5: along y at -8, -4, 0, 4, 8, along z from -32.5 to 7.5.
constexpr FingerFace kFace{0.01, -0.035, 0.01, 0.04};

Result<ContactPatches> pressed(const TriangleMesh& mesh, const Vector3d& place,
                               const FingerFace& face = kFace,
                               const ContactPatchConfig& config = {}) {
    return contact_patches(TriangleBvh(mesh, 1e-8), Eigen::Isometry3d(Eigen::Translation3d(place)),
                           face, config);
}

// A block 40 wide: all 45 cells press alike. A uniform rectangle's half extents come out as they
// are; the mean distance of the cells from the centre is summed here anew.
TEST(ContactPatch, AFlatSidePressesTheWholeFace) {
    const auto patches = pressed(test::box({0.04, 0.06, 0.12}, 300), {0.003, 0, 0});
    ASSERT_TRUE(patches.ok());
    double radius = 0.0;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -4; j <= 4; ++j) radius += std::hypot(0.004 * i, 0.005 * j) / 45.0;
    }
    for (const ContactPatch& patch : {patches.value().left, patches.value().right}) {
        EXPECT_NEAR(patch.share, 1.0, 1e-12);
        EXPECT_NEAR(patch.half_width_m, 0.01, 1e-12);
        EXPECT_NEAR(patch.half_height_m, 0.0225, 1e-12);
        EXPECT_NEAR(patch.mean_radius_m, std::hypot(radius, 0.001), 1e-12);
    }
    EXPECT_LT((patches.value().left.center_G - Vector3d(-0.023, 0, -0.0125)).norm(), 1e-9);
    EXPECT_LT((patches.value().right.center_G - Vector3d(0.017, 0, -0.0125)).norm(), 1e-9);
}

// The block's top at 60, the TCP at 80: the cells at 47.5, 52.5 and 57.5 press, 27.5 below the TCP
// in the mean. Three cells of 5: half of 15.
TEST(ContactPatch, OnlyWhatMeetsTheObjectPresses) {
    const auto patches = pressed(test::box({0.04, 0.06, 0.12}, 300), {0, 0, 0.08});
    ASSERT_TRUE(patches.ok());
    EXPECT_NEAR(patches.value().right.share, 3.0 / 9.0, 1e-12);
    EXPECT_NEAR(patches.value().right.center_G.z(), -0.0275, 1e-9);
    EXPECT_NEAR(patches.value().right.half_height_m, 0.0075, 1e-9);
}

// A round bar of radius 10 along z: at y = 4 it lies 10 - sqrt(84) = 0.835 deeper, at 8 it lies 4.
// Under 1 of compression these cells press with 0.165 and nothing: share (1 + 2 x 0.165) / 5,
// variance 16 x 2 x 0.165 / 1.330.
TEST(ContactPatch, PressureFallsWithTheDepth) {
    const auto patches = pressed(test::cylinder(0.01, 0.12, 200000), {0, 0, 0});
    ASSERT_TRUE(patches.ok());
    const double side = 1.0 - (10.0 - std::sqrt(84.0)), sum = 1.0 + 2.0 * side;
    const ContactPatch& patch = patches.value().right;
    EXPECT_NEAR(patch.share, sum / 5.0, 2e-3);  // the bar is a polygon
    EXPECT_NEAR(patch.half_width_m, 1e-3 * std::sqrt(3.0 * 32.0 * side / sum + 4.0), 2e-5);
    EXPECT_NEAR(patch.half_height_m, 0.0225, 2e-5);
    EXPECT_NEAR(patch.center_G.y(), 0.0, 2e-5);
}

TEST(ContactPatch, WithoutTwoTouchesThereIsNone) {
    const TriangleMesh mesh = test::box({0.04, 0.06, 0.12}, 300);
    const auto code = [&](const Vector3d& place, const FingerFace& face,
                          const ContactPatchConfig& config = {}) {
        const auto patches = pressed(mesh, place, face, config);
        return patches.ok() ? PlanErrorCode::kInternal : patches.error().code;
    };
    EXPECT_EQ(code({0, 0.2, 0}, kFace), PlanErrorCode::kDegenerate);  // beside it
    EXPECT_EQ(code({0, 0, 0}, {0.01, -0.035, 0.01, 0.015}), PlanErrorCode::kDegenerate);  // within
    EXPECT_EQ(code({0, 0, 0}, kFace, {.lines_across = 1}), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code({0, 0, 0}, kFace, {.compression_m = std::numeric_limits<double>::quiet_NaN()}),
              PlanErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace graspd
