// plan() when its caller wants no more.

#include "graspd/planner/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using test::request_for;

/// Says stop from the n-th call on, and counts.
struct StopAfter {
    std::size_t calls_left;
    std::size_t calls = 0;
    bool operator()() {
        ++calls;
        return calls > calls_left;
    }
};

TEST(PlanStops, AtOnceWithNothing) {
    const PlanRequest request = request_for(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03));
    const PlanReply reply = plan(request, {}, [] { return true; });
    EXPECT_EQ(reply.status, PlanStatus::kPartial);
    EXPECT_TRUE(reply.grasps.empty());
    EXPECT_FALSE(reply.message.empty());
    EXPECT_EQ(reply.strategy, "");
}

// The rounds are boundary, wall, whole object. Wherever it stops, the reply holds what the rounds
// before would have given on their own; the later it stops, the more rounds they are.
TEST(PlanStops, WithWhatTheCompletedRoundsGave) {
    PlanRequest request = request_for(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000));
    request.options.max_grasps = 1000;  // all, so that every round shows
    StopAfter never{std::numeric_limits<std::size_t>::max()};
    const PlanReply full = plan(request, {}, std::ref(never));
    ASSERT_EQ(full.status, PlanStatus::kOk);
    test::expect_identical(full, plan(request, {}));
    ASSERT_GT(never.calls, 10U);

    PlanRequest boundary = request, concavity = request;
    boundary.options.sources = kBoundary;
    concavity.options.sources = kBoundary | kWall;
    PlannerConfig unrefined;  // refinement is the last round
    unrefined.search.refined = 0;
    const std::vector<PlanReply> rounds = {plan(boundary, unrefined), plan(concavity, unrefined)};
    std::size_t stage = 0;
    bool seen_none = false;
    std::vector<bool> seen(2, false);
    for (std::size_t n = 0; n < never.calls; n += 1 + n / 8) {
        StopAfter stop{n};
        const PlanReply reply = plan(request, {}, std::ref(stop));
        EXPECT_EQ(reply.status, PlanStatus::kPartial) << n;
        EXPECT_LE(stop.calls, n + 3) << n;  // it does not go on working for long
        if (reply.grasps.empty()) {
            EXPECT_EQ(stage, 0U) << n;
            seen_none = true;
            continue;
        }
        const auto same = [&](const PlanReply& other) {
            return other.grasps.size() == reply.grasps.size() &&
                   std::ranges::equal(other.grasps, reply.grasps, [](const auto& a, const auto& b) {
                       return a.X_FG.matrix() == b.X_FG.matrix() && a.score == b.score;
                   });
        };
        const std::size_t now = same(rounds[0]) ? 0 : 1;
        EXPECT_TRUE(same(rounds[now])) << n;
        EXPECT_GE(now, stage) << n;
        stage = now;
        seen[now] = true;
    }
    EXPECT_TRUE(seen_none);
    EXPECT_TRUE(seen[0]);
    EXPECT_TRUE(seen[1]);
    StopAfter last{never.calls};
    EXPECT_EQ(plan(request, {}, std::ref(last)).status, PlanStatus::kOk);
}

}  // namespace
}  // namespace graspd
