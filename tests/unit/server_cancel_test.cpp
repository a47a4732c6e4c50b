#include <gmock/gmock.h>

#include "describe_state.hpp"
#include "latency_window.hpp"
#include "server_served.hpp"

namespace graspd::server {
namespace {

using test::request;
using test::Served;
using test::SlowPlanner;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

std::unique_ptr<test::FakeRequest> request_of(const std::string& client, const std::string& id) {
    auto out = request(1, id);
    out->id.client_id = client;
    return out;
}

std::vector<std::string> ids(const Served& served) {
    std::vector<std::string> out;
    for (const OutgoingReply& reply : served.written.copy()) {
        out.push_back(reply.to->identity().request_id);
    }
    return out;
}

// Of three open requests one is being planned; the order names another, which waits.
TEST(Cancel, AnswersAWaitingRequestAtOnceAndLeavesTheOthers) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    for (const char* id : {"planned", "waits", "named"}) {
        served.service.handle(request_of("cell", id));
    }
    ASSERT_TRUE(planner.wait_for_calls(1));
    EXPECT_EQ(served.service.cancel({"cell", "named"}), 1u);
    ASSERT_TRUE(served.wait_for(1));
    EXPECT_THAT(ids(served), ElementsAre("named"));
    EXPECT_EQ(served.written.copy()[0].reply.status, PlanStatus::kCancelled);
    EXPECT_EQ(served.written.copy()[0].reply.message, "cancelled by its client");
    EXPECT_EQ(served.service.counters().queued, 1u);  // its place is free again
    planner.release();
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_THAT(ids(served), ElementsAre("named", "planned", "waits"));
    EXPECT_EQ(planner.calls(), 2);  // what was cancelled is never planned
}

// The planner of the cancelled request is told to stop, so the one after it is planned.
TEST(Cancel, StopsThePlannerOfThatRequest) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request_of("cell", "first"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    EXPECT_EQ(served.service.cancel({"cell", "first"}), 1u);
    served.service.handle(request_of("cell", "second"));
    ASSERT_TRUE(planner.wait_for_calls(2));
    planner.release();
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kCancelled, PlanStatus::kOk));
    EXPECT_EQ(served.service.counters().open, 0u);
}

TEST(Cancel, WithoutAnIdNamesEveryRequestOfThatClientAlone) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request_of("mine", "a"));
    served.service.handle(request_of("mine", "b"));
    served.service.handle(request_of("yours", "c"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    EXPECT_EQ(served.service.cancel({"nobody", ""}), 0u);
    EXPECT_EQ(served.service.cancel({"yours", "a"}), 0u);
    EXPECT_EQ(served.service.cancel({"mine", ""}), 2u);
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(ids(served), UnorderedElementsAre("a", "b"));
    planner.release();
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_EQ(served.statuses()[2], PlanStatus::kOk);
}

TEST(Cancel, OfAnAnsweredRequestDoesNothing) {
    Served served(test::plan_at_once);
    served.service.handle(request_of("cell", "done"));
    ASSERT_TRUE(served.wait_for(1));
    EXPECT_EQ(served.service.cancel({"cell", "done"}), 0u);
    served.service.handle(request_of("cell", "done"));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kOk, PlanStatus::kOk));
}

// A retry of what was cancelled is planned: the refusal says nothing about the request.
TEST(Cancel, ARetryIsPlanned) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request_of("cell", "again"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    ASSERT_EQ(served.service.cancel({"cell", "again"}), 1u);
    planner.release();
    served.service.handle(request_of("cell", "again"));
    ASSERT_TRUE(served.wait_for(2));
    EXPECT_EQ(served.statuses()[1], PlanStatus::kOk);
    EXPECT_EQ(served.written.copy()[1].attempt, 2u);
}

// Other planners answer it: neither what waits nor what is being planned gets a reply from here.
TEST(HandOver, LeavesEveryOpenRequestWithoutAnAnswer) {
    SlowPlanner planner;
    Served served(std::ref(planner), Served::one_worker(4));
    served.service.handle(request(1, "planned"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    served.service.handle(request(1, "waits"));
    EXPECT_EQ(served.service.hand_over(), 2u);
    EXPECT_EQ(served.service.counters().open, 0u);
    planner.release();
    EXPECT_TRUE(served.service.stop(std::chrono::seconds(5)));
    EXPECT_THAT(served.written.copy(), testing::IsEmpty());
    EXPECT_EQ(served.service.counters().lost, 0u);
}

TEST(DescribeState, TellsWhatIsShared) {
    PlannerState state;
    describe_share({.peers = 2, .held = 3, .taken_over = 4, .forgotten = 5, .takes_part = true},
                   state);
    EXPECT_EQ(state.peers, 2u);
    EXPECT_EQ(state.held_requests, 3u);
    EXPECT_EQ(state.taken_over, 4u);
}

TEST(DescribeState, TellsWhatTheServiceDoes) {
    SlowPlanner planner;
    ServerConfig config = Served::one_worker(2);
    Served served(std::ref(planner), config);
    Gripper gripper;
    gripper.name = "claw";
    const auto state = [&](bool stopping) {
        return describe_state(served.service.counters(), config, {&gripper, 1}, stopping);
    };
    EXPECT_EQ(state(false).mode, PlannerState::Mode::kReady);
    served.service.handle(request(1, "planned"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    served.service.handle(request(1, "waits"));
    EXPECT_EQ(state(false).mode, PlannerState::Mode::kReady);
    served.service.handle(request(1, "waits too"));
    const PlannerState full = state(false);
    EXPECT_EQ(full.mode, PlannerState::Mode::kFull);
    EXPECT_EQ(full.queue_length, 2u);
    EXPECT_EQ(full.queue_capacity, 2u);
    EXPECT_EQ(full.workers, 1u);
    EXPECT_EQ(full.busy_workers, 1u);
    EXPECT_EQ(full.requests, 3u);
    EXPECT_THAT(full.grippers, ElementsAre("claw"));
    EXPECT_EQ(state(true).mode, PlannerState::Mode::kStopping);
    planner.release();
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_EQ(state(false).replies[static_cast<int>(PlanStatus::kOk)], 3u);
}

// By hand: of 1..100 half are at most 50, and 95 of them at most 95.
TEST(LatencyWindow, QuantilesAreThoseOfTheLast256) {
    LatencyWindow window;
    EXPECT_EQ(window.quantile_ms(0.5), 0.0);
    window.add(7.0);
    EXPECT_EQ(window.quantile_ms(0.5), 7.0);
    EXPECT_EQ(window.quantile_ms(0.95), 7.0);
    LatencyWindow hundred;
    for (int i = 100; i >= 1; --i) hundred.add(i);
    EXPECT_EQ(hundred.quantile_ms(0.5), 50.0);
    EXPECT_EQ(hundred.quantile_ms(0.95), 95.0);
    EXPECT_EQ(hundred.quantile_ms(1.0), 100.0);
    for (int i = 0; i < 256; ++i) hundred.add(3.0);
    EXPECT_EQ(hundred.quantile_ms(1.0), 3.0);  // the earlier ones are forgotten
}

}  // namespace
}  // namespace graspd::server
