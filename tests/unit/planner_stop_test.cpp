// plan() when its caller wants no more.

#include "graspd/planner/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "graspd/base/triangle_bvh.hpp"
#include "graspd/concavity/outer_hull.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/principal_frame.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using test::request_for;

/// Says stop from the n-th call on, and counts. Asked by several threads.
struct StopAfter {
    std::size_t calls_left;
    std::atomic<std::size_t> calls = 0;
    explicit StopAfter(std::size_t left) : calls_left(left) {}
    bool operator()() { return ++calls > calls_left; }
};

TEST(PlanStops, AtOnceWithNothing) {
    const PlanRequest request = request_for(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03));
    const PlanReply reply = plan(request, {}, [] { return true; });
    EXPECT_EQ(reply.status, PlanStatus::kPartial);
    EXPECT_TRUE(reply.grasps.empty());
    EXPECT_FALSE(reply.message.empty());
    EXPECT_EQ(reply.strategy, "");
}

/// Every call of stop_point() is a place where a plan may end: visits some of them, near one
/// another at first.
template <class Visit>
void at_some_places(std::size_t calls, Visit&& visit) {
    for (std::size_t n = 0; n < calls; n += 1 + n / 8) visit(n);
    visit(calls - 1);
}

// The rounds are boundary, wall, whole object, refinement. Wherever it stops, the reply holds what
// the rounds before would have given on their own, and not less than an earlier stop.
TEST(PlanStops, WithWhatTheCompletedRoundsGave) {
    PlanRequest request = request_for(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 1000));
    request.options.max_grasps = 1000;  // all, so that every round shows
    StopAfter never(std::numeric_limits<std::size_t>::max());
    const PlanReply full = plan(request, {}, std::ref(never));
    ASSERT_EQ(full.status, PlanStatus::kOk);
    test::expect_identical(full, plan(request, {}));
    ASSERT_GT(never.calls, 100U);

    PlanRequest boundary = request, concavity = request;
    boundary.options.sources = kBoundary;
    concavity.options.sources = kBoundary | kWall;
    PlannerConfig unrefined;  // refinement is the last round
    unrefined.search.refined = 0;
    const std::vector<PlanReply> rounds = {plan(boundary, unrefined), plan(concavity, unrefined),
                                           plan(request, unrefined), plan(request, {})};
    const auto round_of = [&](const PlanReply& reply) {
        const auto same = [&](const PlanReply& other) {
            return std::ranges::equal(other.grasps, reply.grasps, [](const auto& a, const auto& b) {
                return a.X_FG.matrix() == b.X_FG.matrix() && a.score == b.score;
            });
        };
        return static_cast<std::size_t>(std::ranges::find_if(rounds, same) - rounds.begin());
    };
    std::size_t last_round = 0, empty = 0;
    std::set<std::size_t> seen;
    at_some_places(never.calls, [&](std::size_t n) {
        StopAfter stop(n);
        const PlanReply reply = plan(request, {}, std::ref(stop));
        EXPECT_EQ(reply.status, PlanStatus::kPartial) << n;
        EXPECT_TRUE(reply.message.starts_with("stopped in ")) << reply.message;
        EXPECT_LE(stop.calls, n + 64) << n;  // each thread ends at its next place
        if (reply.grasps.empty()) {
            ++empty;
            EXPECT_TRUE(seen.empty()) << n;
            return;
        }
        const std::size_t round = round_of(reply);
        EXPECT_LT(round, rounds.size()) << n << ": the grasps of no round";
        EXPECT_GE(round, last_round) << n;
        last_round = round;
        seen.insert(round);
    });
    EXPECT_GT(empty, 0U);
    EXPECT_GE(seen.size(), 2U);
    StopAfter last(never.calls);
    EXPECT_EQ(plan(request, {}, std::ref(last)).status, PlanStatus::kOk);
}

/// How often a piece of work asks whether it is to stop.
template <class Work>
std::size_t asks_of(Work&& work) {
    std::atomic<std::size_t> asks = 0;
    const StopQuery query = [&] { return ++asks == 0; };
    const StopScope scope(query);
    work();
    return asks;
}

// No stage that goes over a whole mesh is deaf for longer than a thousand faces take; and it throws
// when it is told to stop, which it answers without a stop.
TEST(PlanStops, WithinEveryStageOfAWholeMesh) {
    const TriangleMesh mesh = test::sphere(0.03, 60000);
    const std::vector<double> depth_m(mesh.vertices.size(), 0.0);
    const std::vector<std::pair<const char*, std::function<void()>>> stages = {
        {"condition_mesh", [&] { ASSERT_TRUE(condition_mesh(mesh, {}).ok()); }},
        {"principal_frame", [&] { ASSERT_TRUE(principal_frame(mesh).ok()); }},
        {"outer_hull", [&] { ASSERT_TRUE(outer_hull(mesh.vertices).ok()); }},
        {"triangle_bvh", [&] { const TriangleBvh tree(mesh, 1e-9); }},
        {"measure_concavity", [&] { ASSERT_TRUE(measure_concavity(mesh, {}).ok()); }},
        {"sample_surface", [&] { ASSERT_TRUE(sample_surface(mesh, depth_m, 0.02, {}).ok()); }},
    };
    const StopQuery stop = [] { return true; };
    for (const auto& [name, stage] : stages) {
        EXPECT_GE(asks_of(stage), mesh.faces.size() / 1024) << name;
        const StopScope scope(stop);
        EXPECT_THROW(stage(), Stopped) << name;
    }
}

}  // namespace
}  // namespace graspd
