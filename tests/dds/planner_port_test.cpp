#include "graspd/dds/planner_port.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <span>

#include "convert_request.hpp"
#include "graspd/base/content_hash.hpp"
#include "graspd/dds/planner_client.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"
#include "support/plan_samples.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using test::Bytes;
using test::loopback_settings;
using test::no_answer;
using test::payload_of;
using test::RawClient;
using test::SharedRequest;
using test::StubPlanner;
using test::verdict;

dds::wire::GraspRequest_ wire_request(const std::string& id = "a request") {
    PlanRequest request = test::small_request();
    request.request_id = id;
    auto out = dds::write_request(request, "raw client").value();
    out.header().stamp().sec(11);
    out.header().stamp().nanosec(22);
    return out;
}

dds::wire::RankedGrasps_ parsed(Bytes bytes) {
    dds::wire::RankedGrasps_ out;
    SerializedPayload_t payload;
    payload.data = bytes.data();
    payload.length = static_cast<std::uint32_t>(bytes.size());
    EXPECT_TRUE(dds::wire::RankedGrasps_PubSubType().deserialize(&payload, &out));
    payload.data = nullptr;  // not the payload's own
    return out;
}

TEST(PlannerPort, ReplyEchoesTheRequestAndNamesThePlanner) {
    StubPlanner planner([](const SharedRequest& request) {
        auto reply = verdict(request, PlanStatus::kNoGrasp, "none");
        reply->attempt = 5;
        reply->reply.request_id = "not this";  // the ids are those of the request
        reply->reply.frame_id = "nor this";
        return reply;
    });
    RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    ASSERT_TRUE(raw.write(payload_of(wire_request())));
    const auto replies = raw.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    const auto reply = parsed(replies[0]);
    EXPECT_EQ(reply.header().frame_id(), "base");
    EXPECT_EQ(reply.header().stamp().sec(), 11);
    EXPECT_EQ(reply.header().stamp().nanosec(), 22u);
    EXPECT_EQ(reply.client_id(), "raw client");
    EXPECT_EQ(reply.request_id(), "a request");
    EXPECT_EQ(reply.attempt(), 5u);
    EXPECT_EQ(reply.status(), 1);
    EXPECT_EQ(reply.message(), "none");
    EXPECT_EQ(reply.planner_id(), "test planner");
    EXPECT_EQ(reply.planner_version(), "1.2.3");
    EXPECT_EQ(reply.config_hash(), "0123456789abcdef");
    const auto requests = planner.wait_for(1);
    EXPECT_EQ(reply.request_writer(), requests[0]->identity().writer);
    EXPECT_NE(reply.request_writer(), (std::array<std::uint8_t, 16>{}));
    EXPECT_TRUE(planner.port().wait_acknowledged(10s));
    EXPECT_EQ(planner.port().lost_replies(), 0u);
}

// The identity's hash is that of the payload, worked out here from the bytes that were sent.
TEST(PlannerPort, IdentityHoldsTheHashOfTheBytes) {
    StubPlanner planner(no_answer);
    RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    const Bytes bytes = payload_of(wire_request());
    const std::uint64_t hash = content_hash(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(raw.write(bytes));
    ASSERT_TRUE(raw.write(bytes));
    ASSERT_TRUE(raw.write(payload_of(wire_request("other"))));
    const auto requests = planner.wait_for(3);
    ASSERT_EQ(requests.size(), 3u);
    EXPECT_EQ(requests[0]->identity().payload_hash, hash);
    EXPECT_EQ(requests[1]->identity().payload_hash, hash);
    EXPECT_NE(requests[2]->identity().payload_hash, hash);
}

TEST(PlannerPort, BadRequestIsAnsweredUnderACleanId) {
    StubPlanner planner([](const SharedRequest& request) {
        const auto converted = request->convert({});
        return verdict(request, PlanStatus::kInvalidRequest,
                       converted.ok() ? "" : converted.error().detail);
    });
    RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    auto sample = wire_request();
    sample.request_id("line\nbreak" + std::string(100, 'x'));
    sample.client_id("\x01");
    ASSERT_TRUE(raw.write(payload_of(sample)));
    const auto replies = raw.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    const auto reply = parsed(replies[0]);
    EXPECT_EQ(reply.request_id(), "line?break" + std::string(54, 'x'));
    EXPECT_EQ(reply.client_id(), "?");
    EXPECT_THAT(reply.message(), testing::HasSubstr("request_id"));
}

// The reply's writer is transient local: who joins after the answer still gets it.
TEST(PlannerPort, LateJoinerGetsTheReply) {
    StubPlanner planner([](const SharedRequest& request) {
        return verdict(request, PlanStatus::kNoGrasp, "early");
    });
    RawClient early;
    ASSERT_TRUE(early.wait_matched());
    ASSERT_TRUE(early.write(payload_of(wire_request())));
    ASSERT_EQ(early.wait_for(1).size(), 1u);
    RawClient late;
    const auto replies = late.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(parsed(replies[0]).message(), "early");
}

// Three times the 256 replies that the profile lets the writer keep: old ones that every reader has
// confirmed make room, and a reader loses none.
TEST(PlannerPort, KeepsWritingWhenItsHistoryIsFull) {
    constexpr std::size_t kCount = 768;
    StubPlanner planner(
        [](const SharedRequest& request) { return verdict(request, PlanStatus::kNoGrasp, ""); });
    RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_TRUE(raw.write(payload_of(wire_request(std::to_string(i))))) << i;
    }
    const auto replies = raw.wait_for(kCount);
    ASSERT_EQ(replies.size(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        EXPECT_EQ(parsed(replies[i]).request_id(), std::to_string(i));
    }
    EXPECT_EQ(planner.port().lost_replies(), 0u);
    EXPECT_EQ(planner.port().rejected_payloads(), 0u);
}

TEST(PlannerPort, NobodyListensAndNothingBlocks) {
    SharedRequest request;
    StubPlanner planner([&](const SharedRequest& r) {
        request = r;
        return verdict(r, PlanStatus::kNoGrasp, "");
    });
    {
        RawClient raw;
        ASSERT_TRUE(raw.wait_matched());
        ASSERT_TRUE(raw.write(payload_of(wire_request())));
        ASSERT_EQ(raw.wait_for(1).size(), 1u);
    }
    for (int i = 0; i < 600; ++i) {
        EXPECT_TRUE(planner.port().write(*verdict(request, PlanStatus::kNoGrasp, ""))) << i;
    }
    EXPECT_TRUE(planner.port().wait_acknowledged(10s));
}

TEST(PlannerPort, StopListeningIsFinal) {
    std::atomic<int> calls{0};
    std::atomic<bool> stopped{false};
    auto opened = PlannerPort::open(loopback_settings(), [&](std::unique_ptr<IncomingRequest>) {
        EXPECT_FALSE(stopped);
        ++calls;
    });
    ASSERT_TRUE(opened.ok());
    const auto port = std::move(opened).value();
    RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    std::jthread sender([&](const std::stop_token& stop) {
        while (!stop.stop_requested() && raw.write(payload_of(wire_request()))) {
        }
    });
    while (calls == 0) std::this_thread::yield();
    port->stop_listening();
    stopped = true;
    const int before = calls;
    sender.request_stop();
    sender.join();
    EXPECT_EQ(calls, before);
    port->stop_listening();  // a second time is harmless
}

TEST(PlannerPort, ThrowingHandlerDoesNotEndTheProcess) {
    std::atomic<int> calls{0};
    auto opened = PlannerPort::open(loopback_settings(), [&](std::unique_ptr<IncomingRequest>) {
        ++calls;
        throw std::bad_alloc();
    });
    ASSERT_TRUE(opened.ok());
    RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    for (int i = 1; i <= 3; ++i) {
        ASSERT_TRUE(raw.write(payload_of(wire_request())));
        const auto deadline = std::chrono::steady_clock::now() + 10s;
        while (calls < i && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
        ASSERT_EQ(calls, i);
    }
}

}  // namespace
}  // namespace graspd
