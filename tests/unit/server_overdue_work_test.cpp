// What the service does for a planner that does not stop in time.

#include <gmock/gmock.h>

#include "server_served.hpp"

namespace graspd::server {
namespace {

using namespace std::chrono_literals;
using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

constexpr double kShort_s = 0.2;  // time enough for a thread to begin, on a loaded machine too

/// A planner that is deaf to its StopQuery when the request's id is "deaf".
class DeafPlanner {
public:
    PlanReply operator()(const PlanRequest& problem, const StopQuery& stop) {
        if (problem.request_id.starts_with("deaf")) {
            deaf_.change([](int& count) { ++count; });
            EXPECT_TRUE(released_.wait([](bool released) { return released; }));
            returned_.change([](int& count) { ++count; });
        }
        return plan_at_once(problem, stop);
    }
    bool wait_until_deaf(int calls) {
        return deaf_.wait([&](int count) { return count >= calls; });
    }
    void release() {
        released_.change([](bool& released) { released = true; });
    }
    bool wait_for_returns(int calls) {
        return returned_.wait([&](int count) { return count >= calls; });
    }

private:
    Watched<int> deaf_, returned_;
    Watched<bool> released_;
};

std::unique_ptr<FakeRequest> request_with(const std::string& id, double budget_s) {
    auto made = request(1, id);
    made->problem.options.time_budget_s = budget_s;
    return made;
}

/// One worker; a plan counts as lost as soon as it has been answered for.
ServerConfig impatient(std::uint32_t abandoned_plans) {
    ServerConfig config = Served::one_worker(8);
    config.abandon_after_ms = 1;
    config.abandoned_plans = abandoned_plans;
    return config;
}

bool wait_for_abandoned(const PlannerService& service, std::uint64_t count) {
    const auto limit = Clock::now() + kLimit;
    while (service.counters().abandoned_plans < count && Clock::now() < limit) {
        std::this_thread::sleep_for(1ms);
    }
    return service.counters().abandoned_plans == count;
}

TEST(OverdueWork, IsAnsweredForAndItsLateReplyDropped) {
    DeafPlanner planner;
    Served served(std::ref(planner), impatient(0));
    const auto start = Clock::now();
    served.service.handle(request_with("deaf", kShort_s));
    ASSERT_TRUE(served.wait_for(1));
    EXPECT_GE(Clock::now() - start, 200ms);
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kPartial));
    const PlanReply reply = served.written.copy()[0].reply;
    EXPECT_EQ(reply.request_id, "deaf");
    EXPECT_THAT(reply.message, HasSubstr("time_budget = 0.2 s"));
    EXPECT_EQ(served.service.counters().open, 0u);
    EXPECT_EQ(served.service.counters().busy, 0u);

    // A new thread has taken the worker's place.
    served.service.handle(request_with("next", 10.0));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_EQ(served.statuses()[1], PlanStatus::kOk);

    planner.release();
    ASSERT_TRUE(planner.wait_for_returns(1));
    EXPECT_TRUE(served.service.stop(10s));  // the old thread has ended too
    EXPECT_EQ(served.statuses().size(), 2u);
    EXPECT_EQ(served.service.counters().busy, 0u);
    EXPECT_EQ(served.service.counters().lost, 0u);
}

// A retry of what was answered for gets that answer.
TEST(OverdueWork, IsNotPlannedAgainForARetry) {
    DeafPlanner planner;
    Served served(std::ref(planner), impatient(0));
    served.service.handle(request_with("deaf", kShort_s));
    ASSERT_TRUE(served.wait_for(1));
    served.service.handle(request_with("deaf", kShort_s));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_EQ(served.written.copy()[1].attempt, 2u);
    EXPECT_EQ(served.statuses()[1], PlanStatus::kPartial);
    planner.release();
    EXPECT_TRUE(served.service.stop(10s));
}

TEST(OverdueWork, LatePlansThatComeBackAreNotAbandoned) {
    DeafPlanner planner;
    ServerConfig config = impatient(1);
    config.abandon_after_ms = 60000;
    Served served(std::ref(planner), config);
    served.service.handle(request_with("deaf", kShort_s));
    ASSERT_TRUE(served.wait_for(1));
    planner.release();
    EXPECT_TRUE(served.service.stop(10s));
    EXPECT_EQ(served.service.counters().abandoned_plans, 0u);
}

TEST(OverdueWork, TwoAbandonedPlansExhaustTheProcessOnce) {
    DeafPlanner planner;
    Watched<int> exhausted;
    Watched<int> written;
    PlannerService service(impatient(2), {{},
                                          test::without_objects(std::ref(planner)),
                                          [&](const auto&) {
                                              written.change([](int& count) { ++count; });
                                              return true;
                                          },
                                          {},
                                          [&] { exhausted.change([](int& count) { ++count; }); }});
    service.start();
    service.handle(request_with("deaf 1", kShort_s));
    ASSERT_TRUE(wait_for_abandoned(service, 1));
    EXPECT_EQ(exhausted.copy(), 0);
    service.handle(request_with("deaf 2", kShort_s));
    ASSERT_TRUE(exhausted.wait([](int count) { return count == 1; }));
    service.handle(request_with("deaf 3", kShort_s));
    ASSERT_TRUE(wait_for_abandoned(service, 3));
    EXPECT_EQ(exhausted.copy(), 1);
    EXPECT_EQ(service.counters().answers[static_cast<int>(PlanStatus::kPartial)], 3u);
    EXPECT_FALSE(service.stop(10ms));  // their threads are lost
    planner.release();
    EXPECT_TRUE(service.stop(10s));
    EXPECT_EQ(written.copy(), 3);
}

// A cancelled request is answered at once; a planner that is deaf to that loses its place too.
TEST(OverdueWork, ACancelledPlanThatDoesNotStopIsReplaced) {
    DeafPlanner planner;
    Served served(std::ref(planner), impatient(0));
    auto deaf = request_with("deaf", kShort_s);
    deaf->id.client_id = "me";
    served.service.handle(std::move(deaf));
    ASSERT_TRUE(planner.wait_until_deaf(1));
    EXPECT_EQ(served.service.cancel({"me", "deaf"}), 1u);
    ASSERT_TRUE(served.wait_for(1));
    served.service.handle(request_with("next", 10.0));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kCancelled, PlanStatus::kOk));
    planner.release();
    EXPECT_TRUE(served.service.stop(10s));
    EXPECT_EQ(served.statuses().size(), 2u);
}

// What waits behind a long plan is answered when its own budget is over.
TEST(OverdueWork, AWaitingRequestIsAnsweredAtItsBudget) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request_with("long", 10.0));
    ASSERT_TRUE(planner.wait_for_calls(1));
    served.service.handle(request_with("short", 0.005));
    ASSERT_TRUE(served.wait_for(1));
    EXPECT_EQ(served.written.copy()[0].reply.request_id, "short");
    EXPECT_THAT(served.written.copy()[0].reply.message, HasSubstr("before planning began"));
    EXPECT_EQ(served.service.counters().queued, 0u);
    planner.release();
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kPartial, PlanStatus::kOk));
    EXPECT_EQ(planner.calls(), 1);
}

}  // namespace
}  // namespace graspd::server
