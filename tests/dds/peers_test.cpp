#include <gmock/gmock.h>

#include <map>
#include <mutex>
#include <set>

#include "convert_request.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"
#include "support/plan_samples.hpp"

// What one planner hears of another, both in this process.

namespace graspd {
namespace {

using test::loopback_settings;
using test::payload_of;
using test::RawClient;
using test::SharedRequest;
using test::StubPlanner;
using test::with_header;
using namespace std::chrono_literals;

dds::Bytes call_bytes(const std::string& id) {
    PlanRequest request = test::small_request();
    request.request_id = id;
    return payload_of(dds::write_request(request, "caller").value());
}

DdsSettings watching() {
    DdsSettings settings = loopback_settings();
    settings.watch_peers = true;
    return settings;
}

/// A planner that answers nothing and notes what it hears of others.
class Watcher {
public:
    Watcher() {
        auto opened = PlannerPort::open(
            watching(),
            [this](auto request) { change([&] { keys_.insert(request->reply_key()); }); }, {}, {},
            {[this](const GuidBytes& peer, bool serves) { change([&] { peers_[peer] = serves; }); },
             [this](const std::string& key) { change([&] { answered_.insert(key); }); }});
        EXPECT_TRUE(opened.ok()) << opened.error().detail;
        port_ = std::move(opened).value();
    }
    ~Watcher() { port_->stop_listening(); }

    PlannerPort& port() { return *port_; }
    /// @return whether the peer is known by now and serves, or does not
    bool wait_serves(const GuidBytes& peer, bool serves) {
        return wait([&] { return peers_.contains(peer) && peers_[peer] == serves; });
    }
    bool wait_answered(std::size_t count) {
        return wait([&] { return answered_.size() >= count && keys_.size() >= count; });
    }
    bool wait_for_answer(const std::string& key) {
        return wait([&] { return answered_.contains(key); });
    }
    std::set<std::string> keys() { return copy(keys_); }
    std::set<std::string> answered() { return copy(answered_); }
    std::map<GuidBytes, bool> peers() { return copy(peers_); }

private:
    template <class T>
    T copy(const T& value) {
        const std::lock_guard lock(mutex_);
        return value;
    }
    template <class Change>
    void change(Change&& apply) {
        const std::lock_guard lock(mutex_);
        apply();
        changed_.notify_all();
    }
    template <class Holds>
    bool wait(Holds&& holds) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, 10s, holds);
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<std::string> keys_;
    std::set<std::string> answered_;
    std::map<GuidBytes, bool> peers_;
    std::unique_ptr<PlannerPort> port_;  // last: its handlers use the rest
};

TEST(Peers, OneServesFromItsFirstWordUntilItStops) {
    Watcher watcher;
    StubPlanner other(test::no_grasp, watching());
    EXPECT_NE(other.port().id(), watcher.port().id());
    PlannerState state;
    ASSERT_TRUE(watcher.port().write_state(state));
    ASSERT_TRUE(other.port().write_state(state));
    EXPECT_TRUE(watcher.wait_serves(other.port().id(), true));
    state.mode = PlannerState::Mode::kStopping;
    ASSERT_TRUE(other.port().write_state(state));
    EXPECT_TRUE(watcher.wait_serves(other.port().id(), false));
    EXPECT_FALSE(watcher.peers().contains(watcher.port().id())) << "it is no peer of its own";
}

TEST(Peers, OneThatIsFullServes) {
    Watcher watcher;
    StubPlanner other(test::no_grasp, watching());
    PlannerState state;
    state.mode = PlannerState::Mode::kFull;
    ASSERT_TRUE(other.port().write_state(state));
    EXPECT_TRUE(watcher.wait_serves(other.port().id(), true));
}

TEST(Peers, OneThatLeavesServesNoMore) {
    Watcher watcher;
    GuidBytes id{};
    {
        StubPlanner other(test::no_grasp, watching());
        id = other.port().id();
        ASSERT_TRUE(other.port().write_state({}));
        ASSERT_TRUE(watcher.wait_serves(id, true));
    }
    EXPECT_TRUE(watcher.wait_serves(id, false));
}

// By the topic, and by the service as both of ROS 2's vendors call it: what the other planner
// answers bears the key of the request that this one holds.
TEST(Peers, RepliesOfOthersNameTheRequestThatOneHolds) {
    Watcher watcher;
    StubPlanner other(test::no_grasp, watching());
    RawClient topic;
    RawClient caller(test::service_topics());
    ASSERT_TRUE(topic.wait_matched(2));
    ASSERT_TRUE(caller.wait_matched(2));
    ASSERT_TRUE(topic.write(call_bytes("one")));
    ASSERT_TRUE(watcher.wait_answered(1));
    ASSERT_NE(caller.call(call_bytes("one")), 0u);
    ASSERT_TRUE(watcher.wait_answered(2));
    ASSERT_NE(caller.call(call_bytes("one")), 0u);
    ASSERT_TRUE(watcher.wait_answered(3));
    ASSERT_TRUE(caller.write(with_header(call_bytes("one"), 5, 6)));
    ASSERT_TRUE(watcher.wait_answered(4));
    ASSERT_TRUE(caller.write(with_header(call_bytes("one"), 5, 7)));
    ASSERT_TRUE(watcher.wait_answered(5));
    EXPECT_EQ(watcher.keys(), watcher.answered());
    EXPECT_EQ(watcher.keys().size(), 5u);
}

// One that came after the reply holds its request no longer than until it hears of it.
TEST(Peers, RepliesFromBeforeAreHeardOf) {
    StubPlanner other(test::no_grasp, watching());
    RawClient topic;
    ASSERT_TRUE(topic.wait_matched());
    ASSERT_TRUE(topic.write(call_bytes("early")));
    ASSERT_EQ(topic.wait_for(1).size(), 1u);
    const std::string key = other.wait_for(1)[0]->reply_key();
    Watcher late;
    EXPECT_TRUE(late.wait_for_answer(key));
}

}  // namespace
}  // namespace graspd
