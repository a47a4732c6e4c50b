#include "graspd/dds/planner_client.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "stub_planner.hpp"
#include "support/plan_samples.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::full_reply;
using test::full_request;
using test::loopback_settings;
using test::no_answer;
using test::SharedRequest;
using test::small_request;
using test::StubPlanner;
using test::verdict;
using testing::HasSubstr;

std::unique_ptr<PlannerClient> open_client(const std::string& id = "client") {
    auto opened = PlannerClient::open(loopback_settings(), id);
    EXPECT_TRUE(opened.ok()) << opened.error().detail;
    return opened.ok() ? std::move(opened).value() : nullptr;
}

TEST(PlannerClient, RequestAndReplyCrossTheWireWhole) {
    Result<PlanRequest> seen = PlanError{};
    StubPlanner planner([&](const SharedRequest& request) {
        seen = request->convert({});
        auto reply = std::make_unique<OutgoingReply>();
        reply->to = request;
        reply->reply = full_reply();
        return reply;
    });
    const auto client = open_client();
    ASSERT_TRUE(client->wait_for_planner(10s));
    const auto reply = client->request(full_request(), 10s, 0);
    ASSERT_TRUE(reply.ok()) << reply.error().detail;
    test::expect_same(full_reply(), reply.value());
    ASSERT_TRUE(seen.ok()) << seen.error().detail;
    test::expect_same(full_request(), seen.value());
}

// 400'000 vertices and as many faces, 14.4 MB: more than any datagram or socket buffer holds.
TEST(PlannerClient, LargeMeshArrivesWhole) {
    PlanRequest request = small_request();
    auto& mesh = std::get<TriangleMesh>(request.object_O);
    for (std::uint32_t i = 0; i < 400'000; ++i) {
        mesh.vertices.emplace_back(i, 0.5 * i, 0.25 * i);
        mesh.faces.push_back({i, i + 1, i + 2});
    }
    Result<PlanRequest> seen = PlanError{};
    StubPlanner planner([&](const SharedRequest& to) {
        seen = to->convert({});
        return verdict(to, PlanStatus::kNoGrasp, "");
    });
    const auto client = open_client();
    ASSERT_TRUE(client->request(request, 20s, 0).ok());
    ASSERT_TRUE(seen.ok());
    const auto& arrived = std::get<TriangleMesh>(seen.value().object_O);
    EXPECT_EQ(arrived.vertices, mesh.vertices);
    EXPECT_EQ(arrived.faces, mesh.faces);
}

// Both use the same request id at the same time; each must get the answer to its own.
TEST(PlannerClient, TwoClientsGetTheirOwnReplies) {
    StubPlanner planner([](const SharedRequest& request) {
        return verdict(request, PlanStatus::kNoGrasp, "for " + request->identity().client_id);
    });
    const auto one = open_client("one");
    const auto two = open_client("two");
    ASSERT_TRUE(one->wait_for_planner(10s));
    ASSERT_TRUE(two->wait_for_planner(10s));
    const auto ask = [](PlannerClient& client, const std::string& expected) {
        for (int i = 0; i < 20; ++i) {
            PlanRequest request = small_request();
            request.request_id = "request " + std::to_string(i);
            const auto reply = client.request(request, 10s, 0);
            ASSERT_TRUE(reply.ok()) << reply.error().detail;
            EXPECT_EQ(reply.value().message, expected);
            EXPECT_EQ(reply.value().request_id, request.request_id);
        }
    };
    std::jthread other([&] { ask(*two, "for two"); });
    ask(*one, "for one");
    other.join();
    const auto requests = planner.wait_for(40);
    ASSERT_EQ(requests.size(), 40u);
}

TEST(PlannerClient, RetryAfterSilenceIsTheSameRequest) {
    int calls = 0;
    StubPlanner planner([&](const SharedRequest& request) -> std::unique_ptr<OutgoingReply> {
        if (++calls < 3) return nullptr;
        return verdict(request, PlanStatus::kNoGrasp, "third");
    });
    const auto client = open_client();
    ASSERT_TRUE(client->wait_for_planner(10s));
    const auto reply = client->request(small_request(), 300ms, 10);
    ASSERT_TRUE(reply.ok()) << reply.error().detail;
    EXPECT_EQ(reply.value().message, "third");
    const auto requests = planner.wait_for(3);
    ASSERT_GE(requests.size(), 3u);
    for (const auto& request : requests) {
        EXPECT_EQ(request->identity().writer, requests[0]->identity().writer);
        EXPECT_EQ(request->identity().request_id, requests[0]->identity().request_id);
        EXPECT_EQ(request->identity().payload_hash, requests[0]->identity().payload_hash);
    }
}

TEST(PlannerClient, SilenceToEveryAttemptIsNoReply) {
    StubPlanner planner(no_answer);
    const auto client = open_client();
    ASSERT_TRUE(client->wait_for_planner(10s));
    const auto reply = client->request(small_request(), 50ms, 2);
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().code, PlanErrorCode::kNoReply);
    EXPECT_THAT(reply.error().detail, HasSubstr("\"small\""));
    EXPECT_EQ(planner.wait_for(3).size(), 3u);
}

TEST(PlannerClient, NoPlannerIsNoReply) {
    const auto client = open_client();
    EXPECT_FALSE(client->wait_for_planner(50ms));
    const auto reply = client->request(small_request(), 50ms, 1);
    ASSERT_FALSE(reply.ok());
    EXPECT_EQ(reply.error().code, PlanErrorCode::kNoReply);
    EXPECT_THAT(reply.error().detail, HasSubstr("no planner"));
}

TEST(PlannerClient, OverloadedIsTriedAgainAndReturnedAtLast) {
    int calls = 0;
    StubPlanner planner([&](const SharedRequest& request) {
        const bool busy = request->identity().request_id == "busy" || ++calls < 3;
        return verdict(request, busy ? PlanStatus::kOverloaded : PlanStatus::kNoGrasp, "");
    });
    const auto client = open_client();
    ASSERT_TRUE(client->wait_for_planner(10s));
    const auto patient = client->request(small_request(), 10s, 5);
    ASSERT_TRUE(patient.ok());
    EXPECT_EQ(patient.value().status, PlanStatus::kNoGrasp);
    EXPECT_EQ(calls, 3);

    PlanRequest busy = small_request();
    busy.request_id = "busy";
    const auto refused = client->request(busy, 10s, 1);
    ASSERT_TRUE(refused.ok());
    EXPECT_EQ(refused.value().status, PlanStatus::kOverloaded);
    EXPECT_EQ(planner.wait_for(5).size(), 5u);
}

// A reply to something else, such as a late one to an earlier request, is passed over.
TEST(PlannerClient, RepliesToOtherRequestsAreIgnored) {
    SharedRequest first;
    PlannerPort* port = nullptr;
    StubPlanner planner([&](const SharedRequest& request) -> std::unique_ptr<OutgoingReply> {
        if (!first) {
            first = request;
            return nullptr;
        }
        EXPECT_TRUE(port->write(*verdict(first, PlanStatus::kNoGrasp, "late")));
        return verdict(request, PlanStatus::kNoGrasp, "right");
    });
    port = &planner.port();
    const auto client = open_client();
    ASSERT_TRUE(client->wait_for_planner(10s));
    EXPECT_FALSE(client->request(small_request(), 200ms, 0).ok());
    PlanRequest second = small_request();
    second.request_id = "second";
    const auto reply = client->request(second, 10s, 0);
    ASSERT_TRUE(reply.ok());
    EXPECT_EQ(reply.value().message, "right");
}

TEST(PlannerClient, BadIdsAreRefusedBeforeAnythingIsSent) {
    EXPECT_EQ(PlannerClient::open(loopback_settings(), "").error().code,
              PlanErrorCode::kInvalidInput);
    EXPECT_EQ(PlannerClient::open(loopback_settings(), std::string(65, 'x')).error().code,
              PlanErrorCode::kInvalidInput);
    const auto client = open_client();
    PlanRequest request = small_request();
    request.request_id = "";
    EXPECT_EQ(client->request(request, 10s, 0).error().code, PlanErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace graspd
