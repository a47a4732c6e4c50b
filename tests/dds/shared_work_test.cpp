#include <gmock/gmock.h>

#include <csignal>
#include <map>
#include <set>
#include <sstream>

#include "daemon_harness.hpp"
#include "support/dds_domain.hpp"
#include "wire_client.hpp"

// Several daemons of one domain that share its requests, as processes.

namespace graspd {
namespace {

using test::box_request;
using test::ChildProcess;
using test::client_settings;
using test::Daemon;
using test::WireClient;
using namespace std::chrono_literals;

/// How often a line of the log holds the text.
std::size_t count_lines(const ChildProcess& process, const std::string& text) {
    std::istringstream log(process.errors());
    std::size_t count = 0;
    for (std::string line; std::getline(log, line);) count += line.find(text) != line.npos ? 1 : 0;
    return count;
}

template <class Holds>
bool wait_until(Holds&& holds) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(10ms);
    }
    return true;
}

class SharedWork : public testing::Test {
protected:
    void start(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            daemons.push_back(std::make_unique<Daemon>(
                domain, std::vector<std::string>{"--workers", "1", "--ros-args", "-p",
                                                 "share.enabled:=true", "-p",
                                                 "server.queue_capacity:=64"}));
        }
        for (const auto& daemon : daemons) {
            ASSERT_TRUE(wait_until([&] {
                return count_lines(*daemon, "serves=true") == count - 1 &&
                       count_lines(*daemon, "event=takes_part") == 1;
            })) << daemon->errors();
        }
        ASSERT_TRUE(client.wait_matched(static_cast<int>(count)));
    }
    void send(std::size_t count, const std::string& name) {
        for (std::size_t i = 0; i < count; ++i) client.send(box_request(name + std::to_string(i)));
    }
    /// How often each request was answered.
    static std::map<std::string, int> answers(const std::vector<WireClient::Reply>& replies) {
        std::map<std::string, int> out;
        for (const auto& reply : replies) ++out[reply.request_id()];
        return out;
    }
    std::size_t written(std::size_t daemon) const {
        return count_lines(*daemons[daemon], "event=request ");
    }
    void stop(std::size_t daemon) const {
        daemons[daemon]->send_signal(SIGTERM);
        EXPECT_EQ(daemons[daemon]->wait_exit(), 0);
    }

    const std::uint32_t domain = test::test_domain();
    WireClient client{client_settings(domain)};
    std::vector<std::unique_ptr<Daemon>> daemons;
};

TEST_F(SharedWork, EachRequestIsAnsweredByOneOfThree) {
    ASSERT_NO_FATAL_FAILURE(start(3));
    send(24, "r");
    const auto replies = client.wait_for(24);
    ASSERT_EQ(replies.size(), 24u);
    EXPECT_EQ(answers(replies).size(), 24u);
    std::set<std::string> planners;
    for (const auto& reply : replies) {
        EXPECT_EQ(reply.status(), dds::wire::RankedGrasps__Constants::STATUS_OK_);
        planners.insert(reply.planner_id());
    }
    EXPECT_EQ(planners.size(), 3u);
    std::size_t all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        stop(i);
        all += written(i);
    }
    EXPECT_EQ(all, 24u) << "nobody wrote a second reply";
}

// A stopped process is alive for the system and dead for its peers; its requests fall to others.
TEST_F(SharedWork, TheOthersAnswerWhatALostOneHad) {
    ASSERT_NO_FATAL_FAILURE(start(3));
    daemons[0]->send_signal(SIGSTOP);
    send(24, "r");
    const auto replies = client.wait_for(24);
    daemons[0]->send_signal(SIGKILL);
    ASSERT_EQ(replies.size(), 24u);
    EXPECT_EQ(answers(replies).size(), 24u);
    EXPECT_EQ(written(0), 0u);
    EXPECT_GT(
        count_lines(*daemons[1], "event=taken_over") + count_lines(*daemons[2], "event=taken_over"),
        0u);
    send(6, "later");
    EXPECT_EQ(answers(client.wait_for(30)).size(), 30u);
}

// Work is taken over from one that is asked to stop, not refused by it.
TEST_F(SharedWork, OneThatStopsLeavesItsRequestsToTheOthers) {
    ASSERT_NO_FATAL_FAILURE(start(2));
    send(24, "r");
    stop(0);
    const auto replies = client.wait_for(24);
    ASSERT_EQ(replies.size(), 24u);
    EXPECT_EQ(answers(replies).size(), 24u);
    for (const auto& reply : replies) {
        EXPECT_EQ(reply.status(), dds::wire::RankedGrasps__Constants::STATUS_OK_);
    }
    stop(1);
    EXPECT_EQ(written(0) + written(1), 24u);
}

TEST_F(SharedWork, TheLastOneThatStopsAnswersWhatIsOpen) {
    ASSERT_NO_FATAL_FAILURE(start(1));
    client.send(test::long_request("long"));
    client.send(box_request("waits"));
    ASSERT_TRUE(daemons[0]->wait_for_error_text("event=received id=waits"));
    stop(0);
    const auto replies = client.wait_for(2);
    ASSERT_EQ(replies.size(), 2u);
    EXPECT_EQ(replies[1].status(), dds::wire::RankedGrasps__Constants::STATUS_CANCELLED_);
}

}  // namespace
}  // namespace graspd
