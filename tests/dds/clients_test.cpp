#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <set>

#include "daemon_harness.hpp"
#include "support/dds_domain.hpp"
#include "wire_client.hpp"

// Clients of another vendor, in processes of their own: cyclone_client.c on Cyclone DDS.

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::ChildProcess;
using test::Daemon;
using test::test_domain;
using testing::HasSubstr;
using testing::StartsWith;

/// Interfaces as docs/interface.md names them: everything stays on loopback.
constexpr const char* kMulticast =
    "<CycloneDDS><Domain><General><Interfaces>"
    "<NetworkInterface name=\"lo\" multicast=\"true\"/>"
    "</Interfaces></General></Domain></CycloneDDS>";
constexpr const char* kPeers =
    "<CycloneDDS><Domain><General><Interfaces>"
    "<NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>40"
    "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
    "</Domain></CycloneDDS>";

class CycloneClient : public ChildProcess {
public:
    explicit CycloneClient(std::vector<std::string> arguments, const char* uri = kMulticast)
        : ChildProcess(set_uri(uri), with_domain(std::move(arguments))) {}

private:
    static const char* set_uri(const char* uri) {
        ::setenv("CYCLONEDDS_URI", uri, 1);
        return CYCLONE_CLIENT_PROGRAM;
    }
    static std::vector<std::string> with_domain(std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"--domain", std::to_string(test_domain())});
        return arguments;
    }
};

struct Load {
    const char* mode;
    const char* faces;  ///< 12 bytes a face, 24 a vertex, of which there are half as many
    const char* gripper;
    const char* status;  ///< how the line of the client begins
};

std::ostream& operator<<(std::ostream& out, const Load& load) {
    return out << load.mode << ' ' << load.faces << " faces";
}

class CycloneLoads : public testing::TestWithParam<Load> {};

TEST_P(CycloneLoads, AreAnswered) {
    const Daemon daemon(test_domain());
    CycloneClient client({GetParam().mode, "--faces", GetParam().faces, "--gripper",
                          GetParam().gripper, "--timeout", "4", "--retries", "1"});
    EXPECT_EQ(client.wait_exit(), 0) << client.errors();
    EXPECT_THAT(client.output(), StartsWith(GetParam().status));
}

// 1 kB, 1 MB, 5 MB, 50 MB. The largest asks for a gripper that nobody knows: what is tried here is
// the way there and back, not the planning of two million faces.
INSTANTIATE_TEST_SUITE_P(
    Sizes, CycloneLoads,
    testing::Values(Load{"topic", "12", "parallel_85", "status=0 grasps=10"},
                    Load{"topic", "42000", "parallel_85", "status=0 grasps=10"},
                    Load{"topic", "210000", "parallel_85", "status=0 grasps=10"},
                    Load{"topic", "2100000", "nobody", "status=5 grasps=0"},
                    Load{"service", "12", "parallel_85", "status=0 grasps=10"},
                    Load{"service", "42000", "parallel_85", "status=0 grasps=10"},
                    Load{"service", "210000", "parallel_85", "status=0 grasps=10"},
                    Load{"service", "2100000", "nobody", "status=5 grasps=0"}));

class CycloneSettings : public testing::TestWithParam<const char*> {};

TEST_P(CycloneSettings, FindThePlanner) {
    const Daemon daemon(test_domain());
    for (const char* mode : {"topic", "service"}) {
        CycloneClient client({mode, "--timeout", "4", "--retries", "1"}, GetParam());
        EXPECT_EQ(client.wait_exit(), 0) << client.errors();
    }
}
INSTANTIATE_TEST_SUITE_P(Interfaces, CycloneSettings, testing::Values(kMulticast, kPeers));

// A fresh volatile reader takes nothing that comes before the writer's first heartbeat: without the
// greeting (reply_writer.hpp) one of five first calls needs a second one.
TEST(CycloneClients, FirstCallsAreAnsweredAtOnce) {
    const Daemon daemon(test_domain());
    std::map<std::string, int> attempts;
    for (int i = 0; i < 20; ++i) {
        CycloneClient client({"service", "--id", "call", "--timeout", "3", "--retries", "3"});
        EXPECT_EQ(client.wait_exit(), 0) << client.errors();
        const auto at = client.output().find("attempt=");
        ASSERT_NE(at, std::string::npos);
        ++attempts[client.output().substr(at, 9)];
    }
    EXPECT_GE(attempts["attempt=1"], 18) << attempts["attempt=2"];
}

TEST(CycloneClients, ALateReaderGetsTheReply) {
    const Daemon daemon(test_domain());
    CycloneClient client({"topic", "--id", "early", "--client", "first"});
    ASSERT_EQ(client.wait_exit(), 0) << client.errors();
    CycloneClient late({"listen", "--count", "1", "--timeout", "9"});
    EXPECT_EQ(late.wait_exit(), 0) << late.errors();
    EXPECT_THAT(late.output(), HasSubstr("id=early client=first"));
}

TEST(CycloneClients, TheExamplePrintsGraspsOrReasons) {
    ::unsetenv("CYCLONEDDS_URI");  // it keeps to loopback by itself
    const std::string domain = std::to_string(test_domain());
    const test::TemporaryFile box("box.off", test::off_text(test::box({0.04, 0.06, 0.08})));
    const test::TemporaryFile wide("wide.off", test::off_text(test::box({0.086, 0.086, 0.086})));
    const Daemon daemon(test_domain());
    ChildProcess good(CYCLONE_EXAMPLE_PROGRAM, {box.path(), "parallel_85", "1", domain});
    EXPECT_EQ(good.wait_exit(), 0) << good.errors();
    EXPECT_THAT(good.output(), StartsWith("OK, 10 grasps."));
    ChildProcess none(CYCLONE_EXAMPLE_PROGRAM, {wide.path(), "parallel_85", "1", domain});
    EXPECT_EQ(none.wait_exit(), 3) << none.errors();
    EXPECT_THAT(none.output(), HasSubstr("candidates: axis_too_wide"));
}

TEST(CycloneClients, TwoWithOneRequestIdGetTheirOwnReplies) {
    const Daemon daemon(test_domain());
    CycloneClient box({"topic", "--id", "same", "--client", "a", "--faces", "12"});
    CycloneClient unknown(
        {"topic", "--id", "same", "--client", "b", "--faces", "12", "--gripper", "nobody"});
    EXPECT_EQ(box.wait_exit(), 0) << box.errors();
    EXPECT_EQ(unknown.wait_exit(), 0) << unknown.errors();
    EXPECT_THAT(box.output(), StartsWith("status=0 grasps=10"));
    EXPECT_THAT(unknown.output(), StartsWith("status=5"));
}

TEST(CycloneClients, OneThatIsKilledHarmsNoOther) {
    const Daemon daemon(test_domain());
    CycloneClient killed({"topic", "--id", "gone", "--faces", "210000"});
    std::this_thread::sleep_for(300ms);  // somewhere between its match and its reply
    killed.send_signal(SIGKILL);
    EXPECT_EQ(killed.wait_exit(), -SIGKILL);
    CycloneClient next({"service", "--timeout", "8"});
    EXPECT_EQ(next.wait_exit(), 0) << next.errors();
    EXPECT_THAT(next.output(), StartsWith("status=0"));
}

// A hundred at once for a queue of sixteen: each is answered once; those that were refused are sent
// again under their ids until they are planned.
TEST(Burst, EveryRequestIsAnsweredAndNoneIsLostByAClientThatRetries) {
    const Daemon daemon(test_domain());
    test::WireClient client(test::client_settings(test_domain()));
    ASSERT_TRUE(client.wait_matched());
    constexpr std::size_t kRequests = 100;
    std::set<std::string> open;
    for (std::size_t i = 0; i < kRequests; ++i) open.insert("burst-" + std::to_string(i));
    std::size_t refused = 0;
    std::size_t answers = 0;
    for (int round = 0; round < 50 && !open.empty(); ++round) {
        const std::set<std::string> sent = open;
        for (const std::string& id : sent) client.send(test::box_request(id));
        const auto replies = client.wait_for(answers + sent.size());
        ASSERT_EQ(replies.size(), answers + sent.size()) << "round " << round;
        std::set<std::string> answered;
        for (std::size_t i = answers; i < replies.size(); ++i) {
            const auto& reply = replies[i];
            EXPECT_TRUE(answered.insert(reply.request_id()).second) << reply.request_id();
            if (reply.status() == 0) open.erase(reply.request_id());
            refused += reply.status() == static_cast<int>(PlanStatus::kOverloaded) ? 1u : 0u;
        }
        EXPECT_EQ(answered, sent);
        answers = replies.size();
    }
    EXPECT_TRUE(open.empty()) << open.size() << " were never planned";
    EXPECT_GT(refused, 0u);
}

}  // namespace
}  // namespace graspd
