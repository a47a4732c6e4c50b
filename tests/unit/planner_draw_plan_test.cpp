#include "graspd/planner/draw_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

// The shapes of a picture against what was put in: a block with a square hole, hands at poses of
// the tests' own.

namespace graspd {
namespace {

constexpr double kHole_m = 0.04;   // wide
constexpr double kDepth_m = 0.03;  // of the hole, and so the deepest concavity

/// Turned by a quarter about z, then carried away: points of O where nobody would take them for F.
Eigen::Isometry3d somewhere() {
    Eigen::Isometry3d X_FO = Eigen::Isometry3d::Identity();
    X_FO.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()));
    X_FO.pretranslate(Eigen::Vector3d(1.0, 2.0, 3.0));
    return X_FO;
}

PlanSubject subject_of(const TriangleMesh& mesh) {
    const auto object = prepare(mesh, {});
    EXPECT_TRUE(object.ok());
    return {object.value(), somewhere(), test::request_for(mesh).grippers};
}

PlanSubject block_with_hole() {
    return subject_of(test::blind_hole_block({0.08, 0.08, 0.06}, kHole_m, kDepth_m));
}

PlanPicture picture_of(const PlanSubject& subject, const std::vector<Grasp>& grasps,
                       const PictureLimits& limits = {}) {
    auto picture = draw_plan(subject, grasps, {}, limits);
    EXPECT_TRUE(picture.ok()) << (picture.ok() ? "" : picture.error().detail);
    return picture.ok() ? std::move(picture).value() : PlanPicture{};
}

bool is_in_hole(const Eigen::Vector3d& p_O) {
    const double half_m = 0.5 * kHole_m + 1e-9;
    return std::abs(p_O.x()) < half_m && std::abs(p_O.y()) < half_m && p_O.z() < 1e-9 &&
           p_O.z() > -kDepth_m - 1e-9;
}

double volume_m3(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& b = mesh.vertices.at(face[1]);
        sum += mesh.vertices.at(face[0]).dot(b.cross(mesh.vertices.at(face[2]))) / 6.0;
    }
    return sum;
}

TEST(DrawPlan, TheObjectStandsAtItsPoseWithItsConcavity) {
    const PlanSubject subject = block_with_hole();
    const PlanPicture picture = picture_of(subject, {});
    EXPECT_EQ(picture.object_F.faces.size(), picture.all_faces);
    EXPECT_NEAR(volume_m3(picture.object_F), 0.08 * 0.08 * 0.06 - kHole_m * kHole_m * kDepth_m,
                1e-12);
    EXPECT_NEAR(picture.deepest_m, kDepth_m, 1e-9);
    ASSERT_EQ(picture.concavity_m.size(), picture.object_F.vertices.size());
    std::size_t on_floor = 0;
    for (std::size_t i = 0; i < picture.concavity_m.size(); ++i) {
        const Eigen::Vector3d p_O = somewhere().inverse() * picture.object_F.vertices[i];
        const double expected_m = is_in_hole(p_O) ? -p_O.z() : 0.0;
        EXPECT_NEAR(picture.concavity_m[i], expected_m, 1e-9) << p_O.transpose();
        on_floor += picture.concavity_m[i] > kDepth_m - 1e-6 ? 1 : 0;
    }
    EXPECT_GE(on_floor, 4u);
    EXPECT_TRUE(picture.hands_F.empty());
}

// Salient is what lies below half the depth.
TEST(DrawPlan, RegionsAreTheSalientSamples) {
    const PlanPicture picture = picture_of(block_with_hole(), {});
    ASSERT_FALSE(picture.regions.empty());
    EXPECT_NEAR(picture.regions[0].depth_m, kDepth_m, 1e-9);
    EXPECT_NEAR(picture.spacing_m, 0.15 * 0.02, 1e-12);
    EXPECT_GT(picture.regions[0].points_F.size(), 100u);
    for (const Eigen::Vector3d& point_F : picture.regions[0].points_F) {
        const Eigen::Vector3d p_O = somewhere().inverse() * point_F;
        EXPECT_TRUE(is_in_hole(p_O)) << p_O.transpose();
        EXPECT_LE(p_O.z(), -0.5 * kDepth_m + 1e-9);
    }
}

Grasp grasp_at(const Eigen::Isometry3d& X_FG, double width_m) {
    Grasp grasp;
    grasp.X_FG = X_FG;
    grasp.width_m = width_m;
    grasp.gripper_name = "parallel_85";
    return grasp;
}

void expect_box(const PicturedPart& part, const Eigen::Isometry3d& X_FG,
                const Eigen::Vector3d& center_G, const Eigen::Vector3d& half_m) {
    const auto* box = std::get_if<OrientedBox>(&part);
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->pose.linear().isApprox(X_FG.linear(), 1e-12));
    EXPECT_LT((box->pose.translation() - X_FG * center_G).norm(), 1e-12);
    EXPECT_LT((box->half_extent - half_m).norm(), 1e-12);
}

// parallel_85 holding 50 mm: fingers of 10 x 20 x 45 mm outside +-25 mm, their tips 10 mm in front
// of G; the palm of 120 x 40 x 80 mm ends where they begin.
TEST(DrawPlan, AHandOfBoxesStandsAtTheGraspsPose) {
    const Eigen::Isometry3d X_FG = somewhere() * Eigen::Translation3d(0.1, 0.2, 0.3);
    const PlanPicture picture = picture_of(block_with_hole(), {grasp_at(X_FG, 0.05)});
    ASSERT_EQ(picture.hands_F.size(), 1u);
    ASSERT_EQ(picture.hands_F[0].size(), 3u);
    expect_box(picture.hands_F[0][0], X_FG, {0.0, 0.0, -0.075}, {0.06, 0.02, 0.04});
    expect_box(picture.hands_F[0][1], X_FG, {-0.03, 0.0, -0.0125}, {0.005, 0.01, 0.0225});
    expect_box(picture.hands_F[0][2], X_FG, {0.03, 0.0, -0.0125}, {0.005, 0.01, 0.0225});
}

/// A left finger that is a cube of 10 mm, its inner side on the pad's plane of the open hand.
PlanSubject with_cube_finger() {
    PlanSubject subject = block_with_hole();
    ConvexPart finger{"finger", GripperMember::kFingerLeft, {}, -1};
    for (const double x : {-0.0525, -0.0425}) {
        for (const double y : {-0.005, 0.005}) {
            for (const double z : {0.11, 0.12}) finger.points.emplace_back(x, y, z);
        }
    }
    subject.grippers[0].convex_parts = {finger};
    return subject;
}

// Closed from 85 to 50 mm the finger has come 17.5 mm inward. G lies 115 mm before the flange.
TEST(DrawPlan, AHandOfConvexPartsIsDrawnByTheirHulls) {
    const Eigen::Isometry3d X_FG = somewhere();
    const PlanPicture picture = picture_of(with_cube_finger(), {grasp_at(X_FG, 0.05)});
    ASSERT_EQ(picture.hands_F.at(0).size(), 1u);
    const auto* hull = std::get_if<TriangleMesh>(picture.hands_F[0].data());
    ASSERT_NE(hull, nullptr);
    EXPECT_EQ(hull->faces.size(), 12u);
    EXPECT_NEAR(volume_m3(*hull), 1e-6, 1e-12);
    Eigen::AlignedBox3d box_G;
    for (const auto& vertex : hull->vertices) box_G.extend(X_FG.inverse() * vertex);
    EXPECT_LT((box_G.min() - Eigen::Vector3d(-0.035, -0.005, -0.005)).norm(), 1e-9);
    EXPECT_LT((box_G.max() - Eigen::Vector3d(-0.025, 0.005, 0.005)).norm(), 1e-9);
}

TEST(DrawPlan, KeepsItsLimits) {
    const Eigen::Isometry3d X_FG = somewhere();
    const PlanPicture picture =
        picture_of(with_cube_finger(), std::vector<Grasp>(5, grasp_at(X_FG, 0.05)), {40, 4});
    EXPECT_LE(picture.object_F.faces.size(), 40u);
    EXPECT_GT(picture.all_faces, 1000u);
    // The deepest place is still there to be seen.
    EXPECT_NEAR(*std::ranges::max_element(picture.concavity_m), kDepth_m, 1e-9);
    std::size_t points = 0;
    for (const PicturedRegion& region : picture.regions) points += region.points_F.size();
    EXPECT_LE(points, 40u + picture.regions.size());  // each keeps its first
    ASSERT_EQ(picture.hands_F.size(), 4u);
    for (const auto& hand : picture.hands_F) {
        EXPECT_EQ(hand.size(), 3u);  // 12 faces are more than 40 / 4: boxes
        EXPECT_TRUE(std::holds_alternative<OrientedBox>(hand[0]));
    }
}

// Half a finger's thickness is the least that counts as concave.
TEST(DrawPlan, AConvexBodyHasNoRegionAndAScaleAllTheSame) {
    const PlanPicture picture = picture_of(subject_of(test::box({0.04, 0.06, 0.08})), {});
    EXPECT_TRUE(picture.regions.empty());
    EXPECT_EQ(picture.object_F.faces.size(), 12u);
    EXPECT_NEAR(picture.deepest_m, 0.005, 1e-12);
}

TEST(DrawPlan, RefusesAGraspOfAnotherGripper) {
    Grasp grasp = grasp_at(somewhere(), 0.05);
    grasp.gripper_name = "hook";
    const auto picture = draw_plan(block_with_hole(), std::vector<Grasp>{grasp}, {}, {});
    ASSERT_FALSE(picture.ok());
    EXPECT_EQ(picture.error().code, PlanErrorCode::kUnknownGripper);
}

}  // namespace
}  // namespace graspd
