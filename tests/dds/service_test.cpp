#include <gmock/gmock.h>

#include <future>
#include <memory>

#include "convert_reply.hpp"
#include "convert_request.hpp"
#include "guid_bytes.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"
#include "support/plan_samples.hpp"

namespace graspd {
namespace {

using test::Bytes;
using test::payload_of;
using test::RawClient;
using test::service_topics;
using test::SharedRequest;
using test::StubPlanner;
using test::verdict;
using test::with_header;
using namespace std::chrono_literals;

dds::wire::GraspRequest_ wire_request(const std::string& id) {
    PlanRequest request = test::small_request();
    request.request_id = id;
    return dds::write_request(request, "caller").value();
}

dds::wire::RankedGrasps_ parsed(Bytes bytes) {
    dds::wire::RankedGrasps_ out;
    const auto* layout = dds::wire_layouts().find("graspd_msgs::srv::dds_::PlanGrasps_Response_");
    EXPECT_TRUE(dds::read_cdr(bytes, *layout, out));
    return out;
}

std::unique_ptr<OutgoingReply> none_for(const SharedRequest& request) {
    return verdict(request, PlanStatus::kNoGrasp, "none for " + request->identity().request_id);
}

// rmw_fastrtps: the members alone; the reply names the caller's reader and its number of the call.
TEST(Service, AnswersInTheStyleOfRmwFastrtps) {
    StubPlanner planner(none_for);
    RawClient caller(service_topics());
    ASSERT_TRUE(caller.wait_matched());
    ASSERT_EQ(caller.call(payload_of(wire_request("first"))), 1u);
    ASSERT_EQ(caller.call(payload_of(wire_request("second"))), 2u);
    const auto replies = caller.wait_for_samples(2);
    ASSERT_EQ(replies.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(replies[i].related.writer_guid(), caller.reader().guid());
        EXPECT_EQ(replies[i].related.sequence_number().to64long(), i + 1);
    }
    EXPECT_EQ(parsed(replies[0].payload).message(), "none for first");
    EXPECT_EQ(parsed(replies[1].payload).message(), "none for second");
    EXPECT_EQ(planner.wait_for(2)[0]->identity().writer, dds::bytes_of(caller.writer().guid()));
}

// rmw_cyclonedds: a header before the members, which comes back byte for byte before the reply's.
TEST(Service, AnswersInTheStyleOfRmwCyclonedds) {
    StubPlanner planner(none_for);
    RawClient caller(service_topics());
    ASSERT_TRUE(caller.wait_matched());
    const Bytes call =
        with_header(payload_of(wire_request("round")), 0x0123456789abcdefu, -0x7edcba9876543210);
    ASSERT_TRUE(caller.write(call));
    const auto replies = caller.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    ASSERT_GT(replies[0].size(), 20u);
    EXPECT_EQ(Bytes(replies[0].begin() + 4, replies[0].begin() + 20),
              Bytes(call.begin() + 4, call.begin() + 20));
    Bytes plain = replies[0];
    plain.erase(plain.begin() + 4, plain.begin() + 20);
    EXPECT_EQ(parsed(plain).message(), "none for round");
}

// The two styles ask for the same thing, and get the same members back.
TEST(Service, BothStylesAreOneService) {
    StubPlanner planner(none_for);
    RawClient caller(service_topics());
    ASSERT_TRUE(caller.wait_matched());
    const Bytes plain = payload_of(wire_request("same"));
    ASSERT_NE(caller.call(plain), 0u);
    ASSERT_EQ(caller.wait_for(1).size(), 1u);
    ASSERT_TRUE(caller.write(with_header(plain, 5, 6)));
    const auto replies = caller.wait_for(2);
    ASSERT_EQ(replies.size(), 2u);
    EXPECT_EQ(with_header(replies[0], 5, 6), replies[1]);
    const auto requests = planner.wait_for(2);
    EXPECT_EQ(requests[0]->identity().payload_hash, requests[1]->identity().payload_hash);
}

// The service tells calls apart by itself: who calls it by hand need not think of an id.
TEST(Service, ACallWithoutAnIdGetsItsNumber) {
    StubPlanner planner(none_for);
    RawClient caller(service_topics());
    ASSERT_TRUE(caller.wait_matched());
    auto request = wire_request("x");
    request.request_id("");
    ASSERT_NE(caller.call(payload_of(request)), 0u);
    ASSERT_TRUE(caller.write(with_header(payload_of(request), 5, 77)));
    const auto requests = planner.wait_for(2);
    ASSERT_EQ(requests.size(), 2u);
    EXPECT_EQ(requests[0]->identity().request_id, "call-1");
    EXPECT_EQ(requests[1]->identity().request_id, "call-77");
    EXPECT_EQ(requests[0]->convert({}).ok(), true);
}

TEST(Service, MalformedCallsAreRefusedAndCounted) {
    StubPlanner planner(none_for);
    RawClient caller(service_topics());
    ASSERT_TRUE(caller.wait_matched());
    const Bytes plain = payload_of(wire_request("good"));
    Bytes cut(plain.begin(), plain.end() - 40);
    Bytes huge = plain;
    std::fill_n(huge.begin() + 12, 4, std::uint8_t{0xff});  // the frame's length
    ASSERT_NE(caller.call(cut), 0u);
    ASSERT_NE(caller.call(huge), 0u);
    ASSERT_TRUE(caller.write(with_header(cut, 1, 2)));
    ASSERT_TRUE(caller.write({0, 1, 0, 0, 1, 2, 3, 4}));
    ASSERT_TRUE(caller.write(plain));  // no header, and no related sample either
    ASSERT_NE(caller.call(plain), 0u);
    ASSERT_EQ(caller.wait_for(1).size(), 1u);
    EXPECT_EQ(planner.wait_for(1).size(), 1u);
    EXPECT_EQ(planner.port().rejected_payloads(), 5u);
}

// Nothing of it is read but its names, so that its caller can be told.
TEST(Service, ACallAboveTheCapIsRefusedByName) {
    auto large = wire_request("large");
    const Bytes small = payload_of(wire_request("small"));
    large.mesh().vertices().resize(1000);
    DdsSettings settings = test::loopback_settings();
    settings.max_payload_bytes = static_cast<std::uint32_t>(small.size()) + 1000;
    StubPlanner planner(none_for, settings);
    RawClient caller(service_topics());
    ASSERT_TRUE(caller.wait_matched());
    ASSERT_NE(caller.call(payload_of(large)), 0u);
    ASSERT_TRUE(caller.write(with_header(payload_of(large), 5, 6)));
    ASSERT_NE(caller.call(small), 0u);
    ASSERT_EQ(caller.wait_for(3).size(), 3u);
    const auto requests = planner.wait_for(3);
    ASSERT_EQ(requests.size(), 3u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(requests[i]->identity().request_id, "large");
        const auto refused = requests[i]->convert({});
        ASSERT_FALSE(refused.ok());
        EXPECT_THAT(refused.error().detail, testing::HasSubstr("server.max_payload_bytes"));
    }
    EXPECT_EQ(planner.port().rejected_payloads(), 0u);
}

// ROS 2's reply readers are volatile, and this caller's is made after it has asked.
TEST(Service, WaitsForTheCallersReader) {
    StubPlanner planner([](const SharedRequest& request) {
        return verdict(request, PlanStatus::kOverloaded, "at once");
    });
    for (int i = 0; i < 5; ++i) {
        RawClient caller(service_topics());
        const auto deadline = std::chrono::steady_clock::now() + 10s;
        dds::fast::PublicationMatchedStatus status;
        do {
            caller.writer().get_publication_matched_status(status);
        } while (status.current_count == 0 && std::chrono::steady_clock::now() < deadline);
        ASSERT_NE(caller.call(payload_of(wire_request("early"))), 0u);
        ASSERT_EQ(caller.wait_for(1).size(), 1u) << i;
    }
    EXPECT_EQ(planner.port().lost_replies(), 0u);
}

// Who has left cannot read an answer. One that leaves by the topic is nobody's business: its reply
// may have other readers.
TEST(Service, ACallerThatLeavesIsReported) {
    std::promise<std::array<std::uint8_t, 16>> gone;
    auto opened = PlannerPort::open(
        test::loopback_settings(), [](auto) {}, {},
        [&](const auto& writer) { gone.set_value(writer); });  // a second call would throw
    ASSERT_TRUE(opened.ok()) << opened.error().detail;
    auto by_topic = std::make_unique<RawClient>();
    auto caller = std::make_unique<RawClient>(service_topics());
    ASSERT_TRUE(by_topic->wait_matched());
    ASSERT_TRUE(caller->wait_matched());
    const auto writer = dds::bytes_of(caller->writer().guid());
    by_topic.reset();
    auto told = gone.get_future();
    EXPECT_EQ(told.wait_for(100ms), std::future_status::timeout);
    caller.reset();
    ASSERT_EQ(told.wait_for(10s), std::future_status::ready);
    EXPECT_EQ(told.get(), writer);
    opened.value()->stop_listening();
}

}  // namespace
}  // namespace graspd
