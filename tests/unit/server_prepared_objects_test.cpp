// The service with the true planner: an object is prepared once, whoever asks for it, and replies
// are those that a service without memory gives.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "server_served.hpp"
#include "support/plan_checks.hpp"
#include "support/shapes.hpp"

namespace graspd::server {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)
using graspd::test::expect_identical;
using graspd::test::request_for;

/// plan(), with a note of the object that each call got and left.
struct WatchedPlan {
    struct Call {
        PreparedObjectPtr before, after;
    };
    std::shared_ptr<Watched<std::vector<Call>>> calls =
        std::make_shared<Watched<std::vector<Call>>>();

    PlanReply operator()(const PlanRequest& problem, PreparedObjectPtr& object,
                         const StopQuery& stop) const {
        const PreparedObjectPtr before = object;
        PlanReply reply = plan(problem, object, {}, stop);
        calls->change([&](auto& list) { list.push_back({before, object}); });
        return reply;
    }
};

std::unique_ptr<FakeRequest> asking(const std::string& id, const PlanRequest& problem,
                                    const std::string& key = "") {
    auto asked = request(1, id);
    asked->problem = problem;
    asked->problem.request_id = id;
    asked->key = key;
    if (!key.empty()) asked->problem.object_O = TriangleMesh{};
    return asked;
}

/// A small object, and time to plan it a few times over where a sanitizer slows every step.
PlanRequest patient_request() {
    PlanRequest problem = request_for(graspd::test::lopsided(300));
    problem.options.time_budget_s = std::chrono::duration<double>(kLimit).count();
    return problem;
}

PlanRequest with_narrow_fingers(PlanRequest problem) {
    problem.grippers[0].name = "narrow";
    problem.grippers[0].finger_width_m *= 0.7;
    return problem;
}

TEST(PreparedObjects, TheSameObjectIsPreparedOnce) {
    const PlanRequest wide = patient_request();
    const PlanRequest narrow = with_narrow_fingers(wide);
    const std::string key = object_key_of(wide.object_O);
    const WatchedPlan watched;
    Served served{decltype(ServiceParts::plan)(watched)};
    served.service.handle(asking("first", wide));
    served.service.handle(asking("again", narrow));
    served.service.handle(asking("named", narrow, key));
    served.service.handle(asking("named as first", wide, key));
    ASSERT_TRUE(served.wait_for(4));
    const auto calls = watched.calls->copy();
    EXPECT_EQ(calls[0].before, nullptr);
    ASSERT_NE(calls[0].after, nullptr);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(calls[i].before, calls[0].after);
    const std::vector<const PlanRequest*> sent = {&wide, &narrow, &narrow, &wide};
    const auto written = served.written.copy();
    for (std::size_t i = 0; i < 4; ++i) {
        SCOPED_TRACE(i);
        PlanReply cold = plan(*sent[i], {});
        cold.request_id = written[i].reply.request_id;
        expect_identical(cold, written[i].reply);
        EXPECT_EQ(written[i].reply.object_key, key);
    }
    EXPECT_EQ(served.service.counters().cached_objects, 1u);
}

// Room for the geometry alone: requests by key are served by preparing the object each time.
TEST(PreparedObjects, WithoutRoomForItAnObjectIsPreparedAnew) {
    const PlanRequest problem = patient_request();
    ServerConfig config = Served::one_worker(4);
    config.object_cache_bytes = geometry_bytes(problem.object_O) + 100;
    const WatchedPlan watched;
    Served served(decltype(ServiceParts::plan)(watched), config);
    served.service.handle(asking("first", problem));
    served.service.handle(asking("named", problem, object_key_of(problem.object_O)));
    ASSERT_TRUE(served.wait_for(2));
    for (const auto& call : watched.calls->copy()) EXPECT_EQ(call.before, nullptr);
    const auto written = served.written.copy();
    PlanReply cold = plan(problem, {});
    cold.request_id = "named";
    expect_identical(cold, written[1].reply);
}

TEST(PreparedObjects, ManyWorkersMayPrepareTheSameObjectAtOnce) {
    const PlanRequest problem = patient_request();
    ServerConfig config;
    config.workers = 4;
    const WatchedPlan watched;
    Served served(decltype(ServiceParts::plan)(watched), config);
    for (int i = 0; i < 8; ++i) served.service.handle(asking(std::to_string(i), problem));
    ASSERT_TRUE(served.wait_for(8));
    PlanReply cold = plan(problem, {});
    for (const OutgoingReply& out : served.written.copy()) {
        cold.request_id = out.reply.request_id;
        expect_identical(cold, out.reply);
    }
    EXPECT_EQ(served.service.counters().cached_objects, 1u);
}

}  // namespace
}  // namespace graspd::server
