#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gmock/gmock.h>

#include <csignal>
#include <set>
#include <thread>

#include "convert_reply.hpp"
#include "daemon_harness.hpp"
#include "graspd/dds/planner_client.hpp"
#include "graspd/planner/planner.hpp"
#include "wire_client.hpp"

// graspd as users have it: a process, reached over loopback.

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::box_request;
using test::client_settings;
using test::Daemon;
using test::daemon_domain;
using test::long_request;
using test::WireClient;
using testing::HasSubstr;

PlanStatus status_of(const WireClient::Reply& reply) {
    return static_cast<PlanStatus>(reply.status());
}

/// Says who the reply is for, and that it is the first answer.
std::string attempt_of(const WireClient::Reply& reply) {
    return reply.request_id() + "/" + std::to_string(reply.attempt());
}

// The daemon's grasps are those of the planner in this process, to the last bit.
TEST(DaemonProcess, AnswersABoxAsThePlannerDoes) {
    const std::uint32_t domain = daemon_domain(0);
    const Daemon daemon(domain);
    auto client = PlannerClient::open(client_settings(domain), "box client");
    ASSERT_TRUE(client.ok()) << client.error().detail;
    ASSERT_TRUE(client.value()->wait_for_planner(10s));
    const auto reply = client.value()->request(box_request("box"), 10s, 0);
    ASSERT_TRUE(reply.ok()) << reply.error().detail;
    EXPECT_EQ(reply.value().status, PlanStatus::kOk) << reply.value().message;
    EXPECT_EQ(reply.value().request_id, "box");
    EXPECT_EQ(reply.value().frame_id, "table");
    const PlanReply here = plan(box_request("box"), PlannerConfig{});
    EXPECT_EQ(reply.value().object_key, here.object_key);
    ASSERT_EQ(reply.value().grasps.size(), here.grasps.size());
    for (std::size_t i = 0; i < here.grasps.size(); ++i) {
        EXPECT_EQ(reply.value().grasps[i].score, here.grasps[i].score);
        EXPECT_EQ(reply.value().grasps[i].X_FG.translation(), here.grasps[i].X_FG.translation());
    }
    const Grasp& best = reply.value().grasps.at(0);
    EXPECT_GE(best.width_m, 0.04 - 1e-6);  // no side is shorter
    EXPECT_LE(best.width_m, 0.085);        // what parallel_85 opens to
}

TEST(DaemonProcess, TwoClientsGetTheirOwnRepliesToTheSameId) {
    const std::uint32_t domain = daemon_domain(1);
    const Daemon daemon(domain);
    std::vector<std::string> frames(2);
    {
        std::vector<std::jthread> clients;
        for (std::size_t i = 0; i < 2; ++i) {
            clients.emplace_back([&, i] {
                auto client =
                    PlannerClient::open(client_settings(domain), "client " + std::to_string(i));
                ASSERT_TRUE(client.ok()) << client.error().detail;
                PlanRequest request = box_request("same id");
                request.frame_id = "frame " + std::to_string(i);
                const auto reply = client.value()->request(request, 10s, 0);
                ASSERT_TRUE(reply.ok()) << reply.error().detail;
                EXPECT_EQ(reply.value().status, PlanStatus::kOk) << reply.value().message;
                frames[i] = reply.value().frame_id;
            });
        }
    }
    EXPECT_THAT(frames, testing::ElementsAre("frame 0", "frame 1"));
}

// One is being planned, one waits; whoever comes then is refused at once, and everybody is
// answered once.
TEST(DaemonProcess, ABusyPlannerAnswersOverloaded) {
    const std::uint32_t domain = daemon_domain(2);
    const test::TemporaryFile config("busy.yaml", "server:\n  workers: 1\n  queue_capacity: 1\n");
    Daemon daemon(domain, {"--config", config.path()});
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    client.send(long_request("long"));
    ASSERT_TRUE(daemon.wait_for_error_text("event=planning id=long"));
    for (const char* id : {"waits", "refused-1", "refused-2"}) client.send(box_request(id));
    const auto first = client.wait_for(2);
    ASSERT_GE(first.size(), 2u);
    EXPECT_EQ(attempt_of(first[0]), "refused-1/1");
    EXPECT_EQ(attempt_of(first[1]), "refused-2/1");
    EXPECT_EQ(status_of(first[0]), PlanStatus::kOverloaded);
    EXPECT_EQ(status_of(first[1]), PlanStatus::kOverloaded);
    daemon.send_signal(SIGTERM);  // the long one need not be waited for
    std::set<std::string> answered;
    for (const auto& reply : client.wait_for(4)) answered.insert(attempt_of(reply));
    EXPECT_EQ(answered, (std::set<std::string>{"long/1", "waits/1", "refused-1/1", "refused-2/1"}));
    EXPECT_EQ(daemon.wait_exit(), 0);
}

TEST(DaemonProcess, ARetryIsAnsweredFromTheCacheAndOtherBytesAreRefused) {
    const std::uint32_t domain = daemon_domain(3);
    Daemon daemon(domain);
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    PlanRequest request = box_request("box");
    client.send(request);
    ASSERT_EQ(client.wait_for(1).size(), 1u);
    client.send(request);
    ASSERT_EQ(client.wait_for(2).size(), 2u);
    request.options.seed = 5;
    client.send(request);
    const auto replies = client.wait_for(3);
    ASSERT_EQ(replies.size(), 3u);
    EXPECT_EQ(attempt_of(replies[0]), "box/1");
    EXPECT_EQ(attempt_of(replies[1]), "box/2");
    EXPECT_EQ(replies[1].grasps().size(), replies[0].grasps().size());
    EXPECT_EQ(status_of(replies[2]), PlanStatus::kInvalidRequest);
    EXPECT_THAT(replies[2].message(), HasSubstr("request_id = box"));
    EXPECT_EQ(replies[0].config_hash(), config_hash(PlannerConfig{}));
    daemon.send_signal(SIGTERM);
    ASSERT_EQ(daemon.wait_exit(), 0);
    EXPECT_THAT(daemon.errors(), HasSubstr("received=3 ok=2"));
    EXPECT_THAT(daemon.errors(), HasSubstr("repeated=1 lost=0"));
    const auto first = daemon.errors().find("event=planning");
    EXPECT_EQ(daemon.errors().find("event=planning", first + 1), std::string::npos);
}

TEST(DaemonProcess, AnObjectKeyStandsForTheGeometryOfAnEarlierRequest) {
    const std::uint32_t domain = daemon_domain(4);
    const Daemon daemon(domain);
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    client.send(box_request("with mesh"));
    const auto first = client.wait_for(1);
    ASSERT_EQ(first.size(), 1u);
    ASSERT_FALSE(first[0].object_key().empty());
    auto by_key = dds::write_request(box_request("by key"), "wire").value();
    by_key.mesh().vertices().clear();
    by_key.mesh().triangles().clear();
    by_key.object_key(first[0].object_key());
    client.send(by_key);
    ASSERT_EQ(client.wait_for(2).size(), 2u);  // two workers would answer in any order
    by_key.request_id("unknown");
    by_key.object_key("0123456789abcdef");
    client.send(by_key);
    const auto replies = client.wait_for(3);
    ASSERT_EQ(replies.size(), 3u);
    EXPECT_EQ(status_of(replies[1]), status_of(replies[0]));
    ASSERT_EQ(replies[1].grasps().size(), replies[0].grasps().size());
    EXPECT_EQ(replies[1].grasps().at(0).score(), replies[0].grasps().at(0).score());
    EXPECT_EQ(status_of(replies[2]), PlanStatus::kUnknownObject);
    EXPECT_THAT(replies[2].message(), HasSubstr("0123456789abcdef"));
}

TEST(DaemonProcess, AClientKilledWhileItsRequestIsPlannedHarmsNobody) {
    const std::uint32_t domain = daemon_domain(5);
    const auto mesh = std::get<TriangleMesh>(long_request("").object_O);
    const test::TemporaryFile file("long.off", test::off_text(mesh));
    Daemon daemon(domain);
    auto client = PlannerClient::open(client_settings(domain), "survivor");
    ASSERT_TRUE(client.ok()) << client.error().detail;
    ASSERT_TRUE(client.value()->wait_for_planner(10s));
    test::ChildProcess victim(GRASPCTL_PROGRAM,
                              {"request", file.path(), "--domain", std::to_string(domain)});
    ASSERT_TRUE(daemon.wait_for_error_text("client=graspctl")) << victim.errors();
    victim.send_signal(SIGKILL);
    EXPECT_EQ(victim.wait_exit(), -SIGKILL);
    for (int i = 0; i < 3; ++i) {
        const auto reply = client.value()->request(box_request("box " + std::to_string(i)), 10s, 0);
        ASSERT_TRUE(reply.ok()) << reply.error().detail;
        EXPECT_EQ(reply.value().status, PlanStatus::kOk);
    }
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
}

// Promised are 2 s; the bound leaves room for a loaded machine.
TEST(DaemonProcess, SigtermWhilePlanningAnswersAndEndsWithZero) {
    const std::uint32_t domain = daemon_domain(6);
    Daemon daemon(domain, {"--workers", "1"});
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    client.send(long_request("long"));
    ASSERT_TRUE(daemon.wait_for_error_text("event=planning id=long"));
    client.send(box_request("waits"));
    ASSERT_TRUE(daemon.wait_for_error_text("event=received id=waits"));
    const auto start = std::chrono::steady_clock::now();
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
    EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
    const auto replies = client.wait_for(2);
    ASSERT_EQ(replies.size(), 2u);
    EXPECT_EQ(attempt_of(replies[0]), "waits/1");
    EXPECT_EQ(status_of(replies[0]), PlanStatus::kCancelled);
    EXPECT_EQ(attempt_of(replies[1]), "long/1");
    EXPECT_THAT(status_of(replies[1]),
                testing::AnyOf(PlanStatus::kPartial, PlanStatus::kCancelled));
}

// The fence leaves room for what the middleware needs and for small plans, not for a plan of a
// million faces, whose mesh and its doubles alone are 38 MB each.
TEST(DaemonProcess, OutOfMemoryCostsItsRequestAlone) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer's shadow memory is larger than any fence";
#endif
    const std::uint32_t domain = daemon_domain(10);
    const test::TemporaryFile fence(
        "_fence.yaml", "server:\n  workers: 1\n  max_address_space_bytes: 800000000\n");
    Daemon daemon(domain, {"--config", fence.path()});
    auto client = PlannerClient::open(client_settings(domain), "hungry client");
    ASSERT_TRUE(client.ok()) << client.error().detail;
    ASSERT_TRUE(client.value()->wait_for_planner(10s));
    PlanRequest hungry = box_request("hungry");
    hungry.object_O = test::torus(0.05, 0.015, 1000000);
    hungry.options.time_budget_s = 30.0;
    const auto refused = client.value()->request(hungry, 40s, 0);
    ASSERT_TRUE(refused.ok()) << refused.error().detail << daemon.errors();
    EXPECT_EQ(refused.value().status, PlanStatus::kInternalError);
    EXPECT_THAT(refused.value().message, HasSubstr("out of memory"));
    const auto reply = client.value()->request(box_request("modest"), 10s, 0);
    ASSERT_TRUE(reply.ok()) << reply.error().detail << daemon.errors();
    EXPECT_EQ(reply.value().status, PlanStatus::kOk) << reply.value().message;
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
}

TEST(DaemonProcess, AReaderThatJoinsLateGetsTheReply) {
    const std::uint32_t domain = daemon_domain(7);
    const Daemon daemon(domain);
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    client.send(box_request("box"));
    ASSERT_EQ(client.wait_for(1).size(), 1u);
    WireClient late(client_settings(domain));
    const auto replies = late.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(attempt_of(replies[0]), "box/1");
    EXPECT_FALSE(replies[0].grasps().empty());
}

/// Replies of a daemon with so many workers to six requests, without what may differ.
constexpr int kRequests = 5;

std::map<std::string, PlanReply> replies_with(std::uint32_t domain, const std::string& workers) {
    const Daemon daemon(domain, {"--workers", workers});
    WireClient client(client_settings(domain));
    EXPECT_TRUE(client.wait_matched());
    for (int i = 0; i < kRequests; ++i) {
        PlanRequest request = box_request("request " + std::to_string(i));
        request.object_O = test::cup(0.03 + 0.002 * i, 0.08, 0.004);
        request.options.sources = kWall;  // one round is enough, and sanitizers are slow
        client.send(request);
    }
    std::map<std::string, PlanReply> replies;
    for (const auto& reply : client.wait_for(kRequests)) {
        PlanReply read = dds::read_reply(reply).value();
        for (StageReport& stage : read.report.stages) stage.ms = 0.0;
        replies[reply.request_id()] = read;
    }
    return replies;
}

TEST(DaemonProcess, OneAndFourWorkersGiveTheSameBytes) {
    const auto one = replies_with(daemon_domain(8), "1");
    const auto four = replies_with(daemon_domain(9), "4");
    ASSERT_EQ(one.size(), std::size_t{kRequests});
    ASSERT_EQ(four.size(), std::size_t{kRequests});
    const auto bytes = [](const PlanReply& reply) {
        const auto wire = dds::write_reply(reply, {});
        std::vector<char> buffer(dds::wire::RankedGrasps_::getCdrSerializedSize(wire) + 4);
        eprosima::fastcdr::FastBuffer fast(buffer.data(), buffer.size());
        eprosima::fastcdr::Cdr cdr(fast);
        wire.serialize(cdr);
        buffer.resize(cdr.getSerializedDataLength());
        return buffer;
    };
    for (const auto& [id, reply] : one) EXPECT_EQ(bytes(reply), bytes(four.at(id))) << id;
}

}  // namespace
}  // namespace graspd
