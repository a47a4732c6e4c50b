#include <gmock/gmock.h>

#include <random>

#include "convert_request.hpp"
#include "graspd/dds/planner_client.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"
#include "support/plan_samples.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::Bytes;
using test::loopback_settings;
using test::no_answer;
using test::payload_of;
using test::SharedRequest;
using test::StubPlanner;
using test::verdict;

Bytes good_payload() {
    return payload_of(dds::write_request(test::full_request(), "raw").value());
}

/// Payloads that end a daemon with the generated type support, or should leave it with nothing.
std::vector<Bytes> malformed_payloads() {
    const Bytes good = good_payload();
    const auto with = [&](std::size_t at, std::uint8_t value) {
        Bytes bytes = good;
        bytes[at] = value;
        return bytes;
    };
    std::vector<Bytes> out;
    out.push_back(with(good.size() - 15, 2));  // options[0].markers: a boolean of 2
    for (const std::uint8_t id : Bytes{2, 3, 6, 7, 8, 9, 10, 11, 0x63}) out.push_back(with(1, id));
    out.push_back(with(0, 0xc0));
    // 16 bytes: header only, of XCDR2 and of an encapsulation that does not exist.
    out.push_back({0, 9, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    out.push_back({0x7f, 0x7f, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    out.push_back({0, 1, 0, 0});
    for (std::size_t length = 4; length + 4 < good.size(); length += 97) {
        out.emplace_back(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    }
    Bytes huge = good;  // the frame's length: 4 GB
    std::fill_n(huge.begin() + 12, 4, std::uint8_t{0xff});
    out.push_back(huge);
    std::mt19937 random(7);
    for (int i = 0; i < 40; ++i) {
        Bytes noise(static_cast<std::size_t>(16 + 8 * i));
        for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
        noise[0] = 0;
        noise[1] = static_cast<std::uint8_t>(i % 2);
        noise[15] = noise[12] = 0xff;  // the frame's length in either order
        out.push_back(noise);
    }
    return out;
}

// DESIGN 5, measured fact 1: one such sample kills a naive daemon. Here each is dropped and
// counted, more of them than the reader's history holds, while good requests go on and are
// answered.
TEST(MalformedPayloads, AreDroppedWhileGoodRequestsGoOn) {
    StubPlanner planner([](const SharedRequest& request) {
        const auto converted = request->convert({});
        return verdict(request, converted.ok() ? PlanStatus::kNoGrasp : PlanStatus::kInvalidRequest,
                       converted.ok() ? "" : converted.error().detail);
    });
    test::RawClient raw;
    auto opened = PlannerClient::open(loopback_settings(), "good client");
    ASSERT_TRUE(opened.ok());
    const auto client = std::move(opened).value();
    ASSERT_TRUE(raw.wait_matched());
    ASSERT_TRUE(client->wait_for_planner(10s));

    const auto payloads = malformed_payloads();
    ASSERT_GT(payloads.size(), 64u);
    PlanRequest request = test::full_request();
    for (std::size_t i = 0; i < payloads.size(); ++i) {
        ASSERT_TRUE(raw.write(payloads[i])) << i;
        if (i % 10 != 0) continue;
        request.request_id = "good " + std::to_string(i);
        const auto reply = client->request(request, 10s, 0);
        ASSERT_TRUE(reply.ok()) << i << ' ' << reply.error().detail;
        EXPECT_EQ(reply.value().status, PlanStatus::kNoGrasp);
    }
    // The raw writer's last sample is good: when it is answered, all before it have been seen.
    ASSERT_TRUE(raw.write(good_payload()));
    request.request_id = "a request";
    const std::size_t good = (payloads.size() + 9) / 10;
    ASSERT_EQ(raw.wait_for(good + 1).size(), good + 1);
    EXPECT_EQ(planner.port().rejected_payloads(), payloads.size());
    EXPECT_EQ(planner.wait_for(good + 1).size(), good + 1);
}

// It is not read, but its sender can be told.
TEST(MalformedPayloads, PayloadAboveTheCapIsRefusedByName) {
    DdsSettings settings = loopback_settings();
    const Bytes good = good_payload();
    settings.max_payload_bytes = static_cast<std::uint32_t>(good.size()) + 1000;
    StubPlanner planner(no_answer, settings);
    test::RawClient raw;
    ASSERT_TRUE(raw.wait_matched());
    auto sample = dds::write_request(test::full_request(), "raw").value();
    sample.mesh().vertices().resize(1000);
    ASSERT_TRUE(raw.write(payload_of(sample)));
    ASSERT_TRUE(raw.write(good));
    const auto requests = planner.wait_for(2);
    ASSERT_EQ(requests.size(), 2u);
    EXPECT_EQ(planner.port().rejected_payloads(), 0u);
    EXPECT_EQ(requests[0]->identity().client_id, "raw");
    const auto refused = requests[0]->convert({});
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().detail.find("server.max_payload_bytes"), std::string::npos);
    EXPECT_TRUE(requests[1]->convert({}).ok());
}

// A malformed reply must not harm a client either: the right one, sent after it, still arrives.
TEST(MalformedPayloads, ClientSurvivesMalformedReplies) {
    auto joined = dds::Participant::join(loopback_settings());
    ASSERT_TRUE(joined.ok());
    auto* forger = joined.value()->create_writer(
        {"rt/graspd/ranked_grasps", test::raw_type("graspd_msgs::msg::dds_::RankedGrasps_"),
         dds::kReplyEnds},
        nullptr);
    ASSERT_NE(forger, nullptr);
    for (Bytes payload : {Bytes{0, 9, 0, 0, 1, 2, 3, 4}, Bytes{0, 1, 0, 0, 255, 255, 255, 255},
                          Bytes{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255}}) {
        ASSERT_TRUE(forger->write(&payload));  // transient local: the client gets them on joining
    }
    StubPlanner planner([](const SharedRequest& request) {
        return verdict(request, PlanStatus::kNoGrasp, "right");
    });
    auto client = PlannerClient::open(loopback_settings(), "client");
    ASSERT_TRUE(client.ok());
    ASSERT_TRUE(client.value()->wait_for_planner(10s));
    const auto reply = client.value()->request(test::small_request(), 10s, 3);
    ASSERT_TRUE(reply.ok()) << reply.error().detail;
    EXPECT_EQ(reply.value().message, "right");
    EXPECT_EQ(forger->wait_for_acknowledgments({10, 0}),
              eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK);
}

}  // namespace
}  // namespace graspd
