// plan() with hand poses that the request brings along. All lengths in the comments in mm.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "graspd/planner/planner.hpp"
#include "support/collision_scene.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using test::from_above;
using test::rejections_of;
using test::request_for;

// A block of 40 x 60 x 80 about the origin. parallel_85's pads stand 115 before its flange, its
// palm 35 behind the pads' centres.
constexpr double kPads_m = 0.115;

/// The hand that comes from above and closes along x, its TCP at a place.
Eigen::Isometry3d hand_at(double x, double y, double z) {
    Eigen::Isometry3d X_FG = from_above(x, z);
    X_FG.translation().y() = y;
    return X_FG * Eigen::Translation3d(0.0, 0.0, -kPads_m);
}

PlanRequest block_request(std::vector<Eigen::Isometry3d> candidates_FH) {
    PlanRequest request = request_for(test::box({0.04, 0.06, 0.08}));
    request.candidates_FH = std::move(candidates_FH);
    return request;
}

TEST(PlanCandidates, OnlyTheyAreAnsweredEachWithItsIndex) {
    // 10 below the top; the same 1 beside it, which a search would drop as like; across the 60.
    Eigen::Isometry3d across = hand_at(0.0, 0.0, 0.03);
    across.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
    const PlanReply reply =
        plan(block_request({hand_at(0, 0, 0.03), hand_at(0, 0.001, 0.03), across}), {});
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    EXPECT_EQ(reply.strategy, "candidates");
    ASSERT_EQ(reply.grasps.size(), 3u);
    std::vector<std::int32_t> indices;
    for (const Grasp& grasp : reply.grasps) {
        indices.push_back(grasp.candidate);
        EXPECT_EQ(grasp.source, kCandidate);
        EXPECT_NEAR(grasp.width_m, grasp.candidate == 2 ? 0.06 : 0.04, 1e-9);
        EXPECT_GT(grasp.score, 0.0);
    }
    EXPECT_TRUE(std::ranges::is_sorted(reply.grasps, std::greater{}, &Grasp::score));
    std::ranges::sort(indices);
    EXPECT_EQ(indices, (std::vector<std::int32_t>{0, 1, 2}));
    const auto first = std::ranges::find(reply.grasps, 0, &Grasp::candidate);
    EXPECT_LT((first->X_FH.matrix() - hand_at(0, 0, 0.03).matrix()).norm(), 1e-9);
    for (const StageReport& stage : reply.report.stages) {
        EXPECT_NE(stage.name, "planner/find_poses");  // nothing was searched for
    }
}

// A hand 20 to the side, so that the left pad begins 2.5 beside the block: the pads touch at once
// when it stands over the middle.
TEST(PlanCandidates, TheHandIsMovedToTouchOnBothSidesAtOnce) {
    const PlanReply reply = plan(block_request({hand_at(0.02, 0.0, 0.03)}), {});
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    EXPECT_NEAR(reply.grasps.at(0).X_FG.translation().x(), 0.0, 1e-9);
    EXPECT_NEAR(reply.grasps[0].X_FG.translation().z(), 0.03, 1e-9);
    EXPECT_NEAR(reply.grasps[0].width_m, 0.04, 1e-9);
}

// Pads that come forward by 10 while they close over 85: at 40 they stand 125 - 10 * 40 / 85 before
// the flange, which is where it was.
TEST(PlanCandidates, PadsOfALinkageMeetWhereTheyStandWhenClosed) {
    PlanRequest request = block_request({hand_at(0.0, 0.0, 0.03)});
    request.grippers[0].pad_travel = {{0.0, 0.125}, {0.085, kPads_m}};
    const PlanReply reply = plan(request, {});
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    const Grasp& grasp = reply.grasps.at(0);
    EXPECT_LT((grasp.X_FH.matrix() - hand_at(0, 0, 0.03).matrix()).norm(), 1e-6);
    EXPECT_NEAR(grasp.X_FG.translation().z(), 0.03 + kPads_m - (0.125 - 0.01 * 0.04 / 0.085), 1e-6);
}

// 40 deeper the palm stands in the block; 200 to the side there is nothing.
TEST(PlanCandidates, ThoseThatFailAreCountedByTheirReason) {
    const PlanReply reply =
        plan(block_request({hand_at(0, 0, -0.01), hand_at(0.2, 0, 0.03), hand_at(0, 0, 0.03)}), {});
    ASSERT_EQ(reply.status, PlanStatus::kOk) << reply.message;
    ASSERT_EQ(reply.grasps.size(), 1u);
    EXPECT_EQ(reply.grasps[0].candidate, 2);
    EXPECT_EQ(rejections_of(reply, "no_contact"), 1u);
    std::uint64_t all = 0;
    for (const RejectionCount& row : reply.report.rejections) all += row.count;
    EXPECT_EQ(all, 2u);
}

TEST(PlanCandidates, NoneIsNoGrasp) {
    const PlanReply reply = plan(block_request({hand_at(0.2, 0, 0.03)}), {});
    EXPECT_EQ(reply.status, PlanStatus::kNoGrasp);
    EXPECT_TRUE(reply.grasps.empty());
}

TEST(PlanCandidates, KeepToTheApproachCones) {
    PlanRequest request = block_request({hand_at(0, 0, 0.03)});
    request.approach_cones = {{Eigen::Vector3d::UnitX(), 0.5}};
    const PlanReply reply = plan(request, {});
    EXPECT_EQ(reply.status, PlanStatus::kNoGrasp);
    EXPECT_EQ(rejections_of(reply, "outside_approach_cones"), 1u);
}

TEST(PlanCandidates, StopWhenTheCallerWantsNoMore) {
    const PlanReply reply = plan(block_request({hand_at(0, 0, 0.03)}), {}, [] { return true; });
    EXPECT_EQ(reply.status, PlanStatus::kPartial);
    EXPECT_TRUE(reply.grasps.empty());
}

TEST(PlanCandidates, APoseThatIsNoneIsInvalid) {
    Eigen::Isometry3d bad = hand_at(0, 0, 0.03);
    bad.translation().x() = std::numeric_limits<double>::quiet_NaN();
    const PlanReply reply = plan(block_request({hand_at(0, 0, 0.03), bad}), {});
    EXPECT_EQ(reply.status, PlanStatus::kInvalidRequest);
    EXPECT_NE(reply.message.find("candidates[1]"), std::string::npos) << reply.message;
}

}  // namespace
}  // namespace graspd
