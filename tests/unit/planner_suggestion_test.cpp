// What a suggestion promises comes true when it is applied. All lengths in the comments in mm.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "graspd/planner/planner.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"
#include "support/suggestion.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::applied;
using test::planned;
using test::read_suggestion;
using test::request_for;

constexpr double kScoreRounding = 0.0005001;  // three decimals

std::string suggestion_of(const PlanReply& reply) {
    return reply.report.suggestion;
}

/// Plans without success, applies what is suggested, and expects the promised score.
test::ReadSuggestion expect_comes_true(const PlanRequest& request) {
    const PlanReply none = planned(request);
    EXPECT_EQ(none.status, PlanStatus::kNoGrasp);
    const auto read = read_suggestion(suggestion_of(none));
    EXPECT_NE(suggestion_of(none).find("there is a grasp of score "), std::string::npos)
        << suggestion_of(none);
    const PlanReply helped = planned(applied(request, suggestion_of(none)));
    EXPECT_EQ(helped.status, PlanStatus::kOk) << suggestion_of(none);
    if (!helped.grasps.empty()) {
        EXPECT_NEAR(helped.grasps.front().score, read.score, kScoreRounding);
    }
    EXPECT_EQ(suggestion_of(helped), "");  // nobody asked
    return read;
}

// A block of 100 x 120 x 140 needs 100 and the least margin beside each pad, 10 / 2^2: 105.
TEST(Suggestion, HowFarTheGripperMustOpen) {
    const PlanRequest request = request_for(test::box({0.10, 0.12, 0.14}, 500));
    auto read = expect_comes_true(request);
    EXPECT_EQ(read.from["max_width"], 0.085);
    EXPECT_GE(read.to["max_width"], 0.105 - 1e-12);
    EXPECT_LE(read.to["max_width"], 0.1051 + 1e-12);
    EXPECT_EQ(read.to.size(), 1U);
    // One step less is not enough.
    PlanRequest less = request;
    less.grippers.front().max_width_m = 0.1049;
    EXPECT_EQ(planned(less).status, PlanStatus::kNoGrasp);
    const PlanReply none = planned(request);
    ASSERT_FALSE(none.report.near_misses.empty());
    EXPECT_EQ(none.report.near_misses.front().reason, "axis_too_wide");
    EXPECT_NEAR(none.report.near_misses.front().margin, 0.02, 1e-9);
}

// Sides that lean by 20 degrees need a friction of tan 20; the wedge is 110 long, so that opening
// wider would help as well, but by a third and not by a tenth.
TEST(Suggestion, HowRoughThePadsMustBe) {
    const double tangent = std::tan(20.0 * std::numbers::pi / 180.0);
    PlanRequest request =
        request_for(test::wedge(0.05, 0.05 + 2.0 * 0.10 * tangent, 0.11, 0.10, 2000));
    request.options.friction = 0.33;
    auto read = expect_comes_true(request);
    EXPECT_EQ(read.from["friction"], 0.33);
    EXPECT_NEAR(read.to["friction"], tangent, 0.0015);
    EXPECT_GE(read.to["friction"], tangent - 1e-6);
    EXPECT_EQ(read.to.size(), 1U);
}

// The pads approach with a margin of 10 at most: no more clearance is possible.
TEST(Suggestion, HowMuchClearanceThereIs) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    request.options.min_clearance_m = 0.015;
    auto read = expect_comes_true(request);
    EXPECT_EQ(read.from["min_clearance"], 0.015);
    EXPECT_GE(read.to["min_clearance"], 0.0099 - 1e-12);
    EXPECT_LE(read.to["min_clearance"], 0.01);
}

// A block of 60 x 200 x 200 is held along x alone, so the hand comes at right angles to x. (Opening
// by 205 would help as well, but that is more than twice as wide.)
TEST(Suggestion, HowWideTheApproachConeMustBe) {
    PlanRequest request = request_for(test::box({0.06, 0.2, 0.2}, 500));
    request.approach_cones = {{Vector3d::UnitX(), 1.0}};
    auto read = expect_comes_true(request);
    EXPECT_EQ(read.from["half_angle"], 1.0);
    EXPECT_GE(read.to["half_angle"], 0.5 * std::numbers::pi - 1e-6);
    EXPECT_LE(read.to["half_angle"], 0.5 * std::numbers::pi + 0.0011);
    // In a frame that is turned it is the same angle.
    const Eigen::Isometry3d X = test::random_pose(3);
    request.X_FO = X;
    request.approach_cones.front().axis_F = X.linear().col(0);
    EXPECT_NEAR(expect_comes_true(request).to["half_angle"], read.to["half_angle"], 0.0011);
}

/// A block on a table that the hand may approach only from within the table: its cone points up.
PlanRequest from_below(const Vector3d& size) {
    PlanRequest request = request_for(test::box(size, 500));
    request.support_plane = SupportPlane{Vector3d::UnitZ(), -0.5 * size.z()};
    request.approach_cones = {{Vector3d::UnitZ(), 0.3}};
    return request;
}

// Whatever is said comes true. The palm's rear, 115 behind the pads and 100 more on its way, stays
// above the table: from pads at most 70 high the hand comes up by asin(70 / 215) = 19 degrees at
// most, so at 71 from up (1.24 rad) or more.
TEST(Suggestion, AConeThatPointsTheWrongWay) {
    auto read = expect_comes_true(from_below({0.06, 0.04, 0.07}));
    EXPECT_TRUE(read.to.contains("approach_cones") || read.to["half_angle"] > 1.2);
}

// Besides, the block is too wide: neither opening nor directions are enough alone. The best grasp
// is across 100, 120 or 140, with the widest margin of 10 beside each pad at most.
TEST(Suggestion, TwoAtOnceAreNamedBoth) {
    const PlanRequest request = from_below({0.10, 0.12, 0.14});
    auto read = expect_comes_true(request);
    EXPECT_EQ(read.to.size(), 2U);
    EXPECT_GE(read.to["max_width"], 0.105);
    EXPECT_LE(read.to["max_width"], 0.1601 + 1e-12);
    EXPECT_TRUE(read.to.contains("approach_cones") || read.to["half_angle"] > 0.8);
    EXPECT_TRUE(suggestion_of(planned(request)).starts_with("no single limit is enough: with "));
    PlanRequest wide = request, free = request;
    wide.grippers.front().max_width_m = 0.25;
    free.approach_cones.clear();
    EXPECT_EQ(planned(wide).status, PlanStatus::kNoGrasp);
    EXPECT_EQ(planned(free).status, PlanStatus::kNoGrasp);
}

// Inside a solid block there is no way, and that comes true too.
TEST(Suggestion, NothingHelpsWhatIsShutIn) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    request.obstacles = {{test::box({0.5, 0.5, 0.5}), Eigen::Isometry3d::Identity()}};
    const PlanReply none = planned(request);
    EXPECT_EQ(none.status, PlanStatus::kNoGrasp);
    EXPECT_TRUE(suggestion_of(none).starts_with("no grasp even with max_width"))
        << suggestion_of(none);
    EXPECT_EQ(planned(applied(request, suggestion_of(none))).status, PlanStatus::kNoGrasp);
}

// A convex object has no boundary to close along.
TEST(Suggestion, OtherSources) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}, 500));
    request.options.sources = kBoundary;
    EXPECT_TRUE(read_suggestion(suggestion_of(planned(request))).all_sources);
    expect_comes_true(request);
}

// A bar of 40 x 40 x 200 that may be taken only along its length: at its ends, far from its weight.
// From the side its middle is free.
TEST(Suggestion, WithGraspsOnRequestWhatWouldBeBetter) {
    PlanRequest request = request_for(test::box({0.04, 0.04, 0.2}, 1000));
    request.approach_cones = {{Vector3d::UnitZ(), 0.3}};
    request.options.mass_kg = 0.5;
    EXPECT_EQ(suggestion_of(planned(request)), "");
    request.options.want_suggestion = true;
    const PlanReply ends = planned(request);
    ASSERT_EQ(ends.status, PlanStatus::kOk);
    EXPECT_GT(std::abs(ends.grasps.front().X_FG.translation().z()), 0.05);
    const auto read = read_suggestion(suggestion_of(ends));
    EXPECT_NEAR(read.instead, ends.grasps.front().score, kScoreRounding) << suggestion_of(ends);
    EXPECT_GT(read.score, read.instead + 0.01);
    EXPECT_TRUE(read.to.contains("half_angle") || read.to.contains("approach_cones"));
    const PlanReply middle = planned(applied(request, suggestion_of(ends)));
    ASSERT_EQ(middle.status, PlanStatus::kOk);
    EXPECT_NEAR(middle.grasps.front().score, read.score, kScoreRounding);
    EXPECT_LT(std::abs(middle.grasps.front().X_FG.translation().z()), 0.02);
}

// A block that every limit lets through: nothing to relax.
TEST(Suggestion, WithGraspsAndNothingInTheWay) {
    PlanRequest request = request_for(test::box({0.03, 0.04, 0.05}, 500));
    request.options.want_suggestion = true;
    const PlanReply reply = planned(request);
    ASSERT_EQ(reply.status, PlanStatus::kOk);
    EXPECT_TRUE(suggestion_of(reply).starts_with("no limit keeps out")) << suggestion_of(reply);
    request.options.want_suggestion = false;
    const PlanReply silent = planned(request);
    EXPECT_EQ(suggestion_of(silent), "");
    EXPECT_EQ(silent.grasps.size(), reply.grasps.size());
}

TEST(Suggestion, TheSameRequestGetsTheSameBytes) {
    PlanRequest request = request_for(test::wedge(0.05, 0.12, 0.11, 0.10, 2000));
    request.options.friction = 0.2;
    const PlanReply first = plan(request, {});
    EXPECT_NE(suggestion_of(first), "");
    test::expect_identical(first, plan(request, {}));
}

TEST(Suggestion, NoneForWhatCannotBePlannedFor) {
    PlanRequest request = request_for(test::box({0.06, 0.04, 0.08}));
    request.options.want_suggestion = true;
    request.options.friction = -1.0;
    EXPECT_EQ(suggestion_of(plan(request, {})), "");
    request.options.friction = 0.6;
    const PlanReply stopped = plan(request, {}, [] { return true; });
    EXPECT_EQ(stopped.status, PlanStatus::kPartial);
    EXPECT_EQ(suggestion_of(stopped), "");
}

// Stopped wherever: PARTIAL without a suggestion, never a NO_GRASP that another run would say more
// about.
TEST(Suggestion, StoppedMeanwhileThereIsNone) {
    PlanRequest request = request_for(test::wedge(0.05, 0.12, 0.11, 0.10, 1000));
    request.options.friction = 0.2;
    std::atomic<std::size_t> calls = 0;
    std::size_t allowed = std::numeric_limits<std::size_t>::max();
    const StopQuery stop = [&] { return ++calls > allowed; };
    const PlanReply full = plan(request, {}, stop);
    ASSERT_EQ(full.status, PlanStatus::kNoGrasp);
    ASSERT_NE(suggestion_of(full), "");
    const std::size_t all = calls;
    std::size_t in_suggest = 0;
    for (allowed = 0; allowed < all; allowed += 1 + allowed / 2) {
        calls = 0;
        const PlanReply reply = plan(request, {}, stop);
        EXPECT_EQ(reply.status, PlanStatus::kPartial) << allowed;
        EXPECT_EQ(suggestion_of(reply), "") << allowed;
        in_suggest += reply.message.starts_with("stopped in planner/suggest") ? 1 : 0;
    }
    EXPECT_GT(in_suggest, 0U);
}

}  // namespace
}  // namespace graspd
