#include <gmock/gmock.h>

#include "convert_state.hpp"
#include "graspd/dds/status_reader.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::loopback_settings;
using test::no_answer;
using test::payload_of;
using test::RawClient;
using test::SharedRequest;
using test::StubPlanner;
using testing::ElementsAre;

/// Every number different, so that none can stand for another.
PlannerState sample_state() {
    PlannerState state;
    state.mode = PlannerState::Mode::kFull;
    state.queue_length = 1;
    state.queue_capacity = 2;
    state.workers = 3;
    state.busy_workers = 4;
    state.cached_objects = 5;
    state.latency_p50_ms = 6.5;
    state.latency_p95_ms = 7.5;
    state.requests = 8;
    state.replies = {10, 11, 12, 13, 14, 15, 16, 17, 18};
    state.lost_replies = 19;
    state.restarts = 20;
    state.abandoned_plans = 21;
    state.grippers = {"one", "two"};
    return state;
}

// The state was written before there was a reader: transient local.
TEST(PlannerStates, ReachALateReader) {
    StubPlanner planner(no_answer);
    ASSERT_TRUE(planner.port().write_state(sample_state()));
    const auto states = read_planner_states(loopback_settings(), 3s);
    ASSERT_TRUE(states.ok()) << states.error().detail;
    ASSERT_EQ(states.value().size(), 1u);
    const PlannerState& state = states.value()[0];
    EXPECT_EQ(state.planner_id, "test planner");
    EXPECT_EQ(state.version, "1.2.3");
    EXPECT_EQ(state.config_hash, "0123456789abcdef");
    EXPECT_EQ(state.mode, PlannerState::Mode::kFull);
    EXPECT_EQ(state.queue_length, 1u);
    EXPECT_EQ(state.queue_capacity, 2u);
    EXPECT_EQ(state.workers, 3u);
    EXPECT_EQ(state.busy_workers, 4u);
    EXPECT_EQ(state.cached_objects, 5u);
    EXPECT_EQ(state.latency_p50_ms, 6.5);
    EXPECT_EQ(state.latency_p95_ms, 7.5);
    EXPECT_EQ(state.requests, 8u);
    EXPECT_THAT(state.replies, ElementsAre(10, 11, 12, 13, 14, 15, 16, 17, 18));
    EXPECT_EQ(state.lost_replies, 19u);
    EXPECT_EQ(state.rejected_payloads, 0u);
    EXPECT_EQ(state.restarts, 20u);
    EXPECT_EQ(state.abandoned_plans, 21u);
    EXPECT_THAT(state.grippers, ElementsAre("one", "two"));
}

// The latest state of each planner; two of them do not hide one another.
TEST(PlannerStates, AreOnePerPlanner) {
    StubPlanner first(no_answer);
    DdsSettings settings = loopback_settings();
    settings.planner_id = "another planner";
    StubPlanner second(no_answer, settings);
    PlannerState state = sample_state();
    ASSERT_TRUE(second.port().write_state(state));
    state.requests = 9;
    ASSERT_TRUE(second.port().write_state(state));
    ASSERT_TRUE(first.port().write_state(state));
    const auto states = read_planner_states(loopback_settings(), 3s);
    ASSERT_TRUE(states.ok());
    ASSERT_EQ(states.value().size(), 2u);
    EXPECT_EQ(states.value()[0].planner_id, "another planner");
    EXPECT_EQ(states.value()[0].requests, 9u);
    EXPECT_EQ(states.value()[1].planner_id, "test planner");
}

TEST(PlannerStates, AreNoneWithoutAPlanner) {
    const auto states = read_planner_states(loopback_settings(), 300ms);
    ASSERT_TRUE(states.ok());
    EXPECT_TRUE(states.value().empty());
}

TEST(PlannerStates, AreDiagnosticsToo) {
    const auto array = dds::write_diagnostics(sample_state(), "/cell1/planner");
    ASSERT_EQ(array.status().size(), 1u);
    const auto& status = array.status()[0];
    EXPECT_EQ(status.name(), "/cell1/planner: planner");
    EXPECT_EQ(status.level(), 1);  // WARN: it is full
    EXPECT_EQ(status.message(), "FULL");
    std::map<std::string, std::string> values;
    for (const auto& entry : status.values()) values[entry.key()] = entry.value();
    EXPECT_EQ(values.size(), status.values().size());
    EXPECT_EQ(values["queue_length"], "1");
    EXPECT_EQ(values["NO_GRASP"], "11");
    EXPECT_EQ(values["restarts"], "20");
    EXPECT_EQ(values["abandoned_plans"], "21");
    EXPECT_EQ(values["grippers"], "one two");
    PlannerState ready;
    EXPECT_EQ(dds::write_diagnostics(ready, "/graspd").status()[0].level(), 0);
}

TEST(CancelTopic, IsHandedOn) {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<CancelOrder> orders;
    auto port = PlannerPort::open(
        loopback_settings(), [](auto) {},
        [&](const CancelOrder& order) {
            const std::lock_guard lock(mutex);
            orders.push_back(order);
            changed.notify_all();
        });
    ASSERT_TRUE(port.ok()) << port.error().detail;
    test::RawTopics topics;
    topics.request = "rt/graspd/cancel";
    topics.request_type = "graspd_msgs::msg::dds_::CancelRequest_";
    topics.request_ends = dds::kCancelEnds;
    RawClient client(topics);
    ASSERT_TRUE(client.wait_matched());
    dds::wire::CancelRequest_ order;
    order.client_id("cell");
    order.request_id("mug-1");
    ASSERT_TRUE(client.write({0, 1, 0, 0, 255, 255, 255, 255}));  // malformed
    ASSERT_TRUE(client.write(payload_of(order)));
    std::unique_lock lock(mutex);
    ASSERT_TRUE(changed.wait_for(lock, 10s, [&] { return !orders.empty(); }));
    EXPECT_EQ(orders[0].client_id, "cell");
    EXPECT_EQ(orders[0].request_id, "mug-1");
    EXPECT_EQ(port.value()->rejected_payloads(), 1u);
    lock.unlock();
    port.value()->stop_listening();
}

}  // namespace
}  // namespace graspd
