#include "support/rtps_mutations.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "graspd/dds/planner_client.hpp"
#include "supervised_daemon.hpp"
#include "support/dds_domain.hpp"
#include "support/process_table.hpp"

// Wrong RTPS messages below DDS, which no application can catch, at our own daemon on loopback.

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::Datagram;
using test::RtpsMutator;
using test::SupervisedDaemon;
using test::TemporaryFile;
using test::test_domain;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 20161113;
constexpr std::size_t kWholeOneIn = 16;  // recorded messages that keep their statistics

/// INFO_DST, HEARTBEAT (big endian), and one that reaches beyond the end.
const Datagram kThree = [] {
    Datagram bytes = {'R', 'T', 'P', 'S', 2, 3, 1, 15};
    bytes.resize(20);
    bytes.insert(bytes.end(), {0x0e, 0x01, 12, 0});
    bytes.resize(bytes.size() + 12);
    bytes.insert(bytes.end(), {0x07, 0x00, 0, 28});
    bytes.resize(bytes.size() + 28);
    bytes.insert(bytes.end(), {0x15, 0x05, 200, 0, 1, 2, 3, 4});
    return bytes;
}();

TEST(RtpsMutator, FindsTheSubmessages) {
    EXPECT_THAT(test::submessage_offsets(kThree), testing::ElementsAre(20, 36));
    Datagram last = kThree;
    last[36 + 3] = 0;  // a length of 0 reaches to the end
    EXPECT_THAT(test::submessage_offsets(last), testing::ElementsAre(20, 36));
    EXPECT_THAT(test::submessage_offsets(Datagram(20)), testing::IsEmpty());
    EXPECT_THAT(test::submessage_offsets(Datagram()), testing::IsEmpty());
}

TEST(RtpsMutator, LeavesOutTheStatistics) {
    Datagram message(kThree.begin(), kThree.begin() + 36 + 32);
    const Datagram plain = message;
    message.insert(message.end(), {0x80, 0x01, 4, 0, 9, 9, 9, 9});
    EXPECT_EQ(test::without_statistics(message), plain);
    message[20] = 0x80;  // the first of three
    EXPECT_THAT(test::submessage_offsets(test::without_statistics(message)),
                testing::ElementsAre(20));
    EXPECT_EQ(test::without_statistics(Datagram(20)), Datagram(20));
}

TEST(RtpsMutator, TheSameNumberGivesTheSameMessagesAndNoneIsRight) {
    RtpsMutator one({kThree}, 7);
    RtpsMutator same({kThree}, 7);
    RtpsMutator other({kThree}, 8);
    int differ = 0;
    int changed = 0;
    for (int i = 0; i < 200; ++i) {
        const Datagram message = one.next();
        EXPECT_EQ(message, same.next());
        differ += message != other.next();
        changed += message != kThree;
        ASSERT_GE(message.size(), 20u);
        EXPECT_TRUE(std::equal(message.begin(), message.begin() + 4, kThree.begin()));
    }
    EXPECT_GT(differ, 190);
    EXPECT_GT(changed, 180);  // a cut at the end or the same id again changes nothing
}

/// Asks once with a client of its own, and gives what went over the wire meanwhile, to and from.
std::vector<Datagram> record_request(std::uint32_t domain) {
    const auto base = static_cast<std::uint16_t>(7400 + 250 * domain);
    const auto recorder = test::UdpRecorder::open(base, base + 249);
    if (recorder == nullptr) return {};
    auto client = PlannerClient::open(test::client_settings(domain), "recorded");
    EXPECT_TRUE(client.ok()) << client.error().detail;
    const auto reply = client.value()->request(test::box_request("recorded"), 5s, 3);
    EXPECT_TRUE(reply.ok()) << reply.error().detail;
    std::this_thread::sleep_for(300ms);  // confirmations
    return recorder->datagrams();
}

/// Wherever a change puts something behind a statistics submessage the participant aborts; most
/// messages go without, so that the others get further than that.
std::vector<Datagram> mostly_without_statistics(std::vector<Datagram> messages) {
    for (std::size_t i = 0; i < messages.size(); ++i) {
        if (i % kWholeOneIn != 0) messages[i] = test::without_statistics(messages[i]);
    }
    return messages;
}

/// Sends wrong messages to the participant's ports, and waits whenever one has killed it.
class Barrage {
public:
    Barrage(const SupervisedDaemon& daemon, RtpsMutator mutator)
        : daemon_(daemon), mutator_(std::move(mutator)) {}

    /// @return how often the participant died of them
    std::size_t send(std::size_t count) {
        aim();
        for (std::size_t i = 0; i < count; ++i) {
            const Datagram message = mutator_.next();
            test::send_datagram(ports_[i % ports_.size()], message);
            if (i % kVolley + 1 == kVolley || i + 1 == count) pause();
            if (testing::Test::HasFatalFailure()) break;
        }
        return deaths_;
    }

private:
    static constexpr std::size_t kVolley = 8;  // so few that no socket overflows

    /// Discovery and user traffic, both by unicast; and discovery by multicast's port.
    void aim() {
        participant_ = daemon_.participant();
        const std::uint16_t discovery = test::discovery_port(participant_, test_domain());
        ASSERT_NE(discovery, 0);
        ports_ = {discovery, static_cast<std::uint16_t>(discovery + 1),
                  static_cast<std::uint16_t>(7400 + 250 * test_domain())};
    }
    void pause() {
        std::this_thread::sleep_for(2ms);
        if (test::process_state(participant_).value_or('Z') != 'Z' &&
            daemon_.count("event=child_died") == deaths_) {
            return;
        }
        ++deaths_;
        ASSERT_TRUE(daemon_.wait_restarted(deaths_)) << daemon_.errors();
        aim();
    }

    const SupervisedDaemon& daemon_;
    RtpsMutator mutator_;
    pid_t participant_ = 0;
    std::vector<std::uint16_t> ports_;
    std::size_t deaths_ = 0;
};

std::size_t datagram_count() {
    const char* text = std::getenv("GRASPD_MUTATIONS");  // NOLINT(concurrency-mt-unsafe)
    return text == nullptr ? 2000 : std::stoul(text);
}

TEST(RtpsMutations, TheDaemonAnswersAfterwardsAndWasStartedOnceForEachCrash) {
    const TemporaryFile quick("mutations.yaml",
                              "supervisor: {first_wait_s: 0.01, longest_wait_s: 0.05}\n");
    SupervisedDaemon daemon(test_domain(), {"--config", quick.path()});
    const auto seeds = record_request(test_domain());
    if (seeds.empty()) GTEST_SKIP() << "no right to record datagrams";
    ASSERT_GT(seeds.size(), 20u);  // discovery, request, reply, heartbeats, confirmations
    Barrage barrage(daemon, RtpsMutator(mostly_without_statistics(seeds), kSeed));
    const std::size_t sent = datagram_count();
    const std::size_t deaths = barrage.send(sent);
    ASSERT_FALSE(HasFatalFailure());
    std::this_thread::sleep_for(200ms);  // the last volley may kill as well

    auto client = PlannerClient::open(test::client_settings(test_domain()), "afterwards");
    ASSERT_TRUE(client.ok()) << client.error().detail;
    const auto reply = client.value()->request(test::box_request("afterwards"), 3s, 10);
    ASSERT_TRUE(reply.ok()) << reply.error().detail << '\n' << daemon.errors();
    EXPECT_EQ(reply.value().status, PlanStatus::kOk);
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0) << daemon.errors();
    const std::size_t crashes = daemon.count("event=child_died");
    std::cout << "seeds=" << seeds.size() << " datagrams=" << sent << " crashes=" << crashes
              << '\n';
    EXPECT_LE(deaths, crashes);
    EXPECT_LE(crashes, deaths + 1);  // the last volley's
    EXPECT_EQ(daemon.count("event=child_started"), crashes + 1);
    EXPECT_THAT(daemon.errors(),
                HasSubstr("queue_capacity=16 restarts=" + std::to_string(crashes)));
}

}  // namespace
}  // namespace graspd
