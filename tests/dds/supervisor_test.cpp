#include <gmock/gmock.h>
#include <sys/statvfs.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "graspd/dds/planner_client.hpp"
#include "shm_segments.hpp"
#include "supervised_daemon.hpp"
#include "support/dds_domain.hpp"
#include "support/process_table.hpp"

// graspd --supervise from outside: what kills the participant, and what becomes of it.

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::ChildProcess;
using test::SupervisedDaemon;
using test::TemporaryFile;
using test::test_domain;
using testing::HasSubstr;

class SupervisorTest : public testing::Test {
protected:
    /// Kills the participant by one malformed datagram.
    static void abort_by_datagram(const SupervisedDaemon& daemon) {
        const auto port = test::discovery_port(daemon.participant(), test_domain());
        ASSERT_NE(port, 0);
        test::send_datagram(port, test::aborting_datagram());
    }

    const TemporaryFile quick_{"quick.yaml", "supervisor: {first_wait_s: 0.05}\n"};
};

TEST_F(SupervisorTest, ClientsThatRetryLoseNothingWhenTheParticipantIsKilled) {
    SupervisedDaemon daemon(test_domain(), {"--config", quick_.path()});
    auto client = PlannerClient::open(test::client_settings(test_domain()), "survivor");
    ASSERT_TRUE(client.ok()) << client.error().detail;
    const auto ask = [&](const std::string& id) {
        const auto reply = client.value()->request(test::box_request(id), 2s, 10);
        ASSERT_TRUE(reply.ok()) << reply.error().detail;
        EXPECT_EQ(reply.value().status, PlanStatus::kOk);
    };
    ask("before");
    abort_by_datagram(daemon);
    ask("after the first datagram");
    ASSERT_TRUE(daemon.wait_restarted(1)) << daemon.errors();
    ::kill(daemon.participant(), SIGKILL);
    ask("after kill -9");
    ASSERT_TRUE(daemon.wait_restarted(2)) << daemon.errors();
    abort_by_datagram(daemon);
    ask("after the second datagram");
    ASSERT_TRUE(daemon.wait_restarted(3)) << daemon.errors();
    ChildProcess status(GRASPCTL_PROGRAM,
                        {"status", "--domain", std::to_string(test_domain()), "--format", "json"});
    EXPECT_EQ(status.wait_exit(), 0) << status.errors();
    EXPECT_THAT(status.output(), HasSubstr("\"restarts\": 3"));
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
    EXPECT_EQ(daemon.count("event=child_died signal=6"), 2u) << daemon.errors();
    EXPECT_EQ(daemon.count("event=child_died signal=9"), 1u);
    EXPECT_EQ(daemon.count("event=child_died"), 3u);
    EXPECT_THAT(daemon.errors(), HasSubstr("restarts=1 backoff_ms=50"));
    EXPECT_THAT(daemon.errors(), HasSubstr("restarts=3 backoff_ms=200"));
    EXPECT_THAT(daemon.errors(), HasSubstr("queue_capacity=16 restarts=3"));
}

TEST_F(SupervisorTest, GraspctlRetriesUntilTheParticipantIsBack) {
    const TemporaryFile slow("slow.yaml", "supervisor: {first_wait_s: 2}\n");
    const TemporaryFile box("box.off", test::off_text(test::box({0.04, 0.06, 0.08})));
    SupervisedDaemon daemon(test_domain(), {"--config", slow.path()});
    abort_by_datagram(daemon);
    ASSERT_TRUE(daemon.wait_for_error_text("event=child_died signal=6")) << daemon.errors();
    ChildProcess request(GRASPCTL_PROGRAM,
                         {"request", box.path(), "--domain", std::to_string(test_domain()),
                          "--timeout", "1000", "--retries", "8"});
    EXPECT_EQ(request.wait_exit(), 0) << request.errors();
    EXPECT_EQ(daemon.count("event=ready"), 2u);
}

TEST_F(SupervisorTest, SigtermAndSigintArePassedOnAndNothingIsLeft) {
    for (const int signal : {SIGTERM, SIGINT}) {
        SupervisedDaemon daemon(test_domain());
        const pid_t participant = daemon.participant();
        daemon.send_signal(signal);
        EXPECT_EQ(daemon.wait_exit(), 0) << daemon.errors();
        EXPECT_EQ(test::process_state(participant), std::nullopt);  // not even a zombie
        EXPECT_THAT(daemon.errors(), HasSubstr("event=stopped received=0"));
        EXPECT_EQ(daemon.count("event=child_ended exit_code=0"), 1u);
    }
}

TEST_F(SupervisorTest, SigtermBetweenTwoLivesEndsWithZeroAtOnce) {
    const TemporaryFile slow("slow.yaml", "supervisor: {first_wait_s: 60, longest_wait_s: 60}\n");
    SupervisedDaemon daemon(test_domain(), {"--config", slow.path()});
    ::kill(daemon.participant(), SIGSEGV);
    ASSERT_TRUE(daemon.wait_for_error_text("event=child_died signal=11")) << daemon.errors();
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
    EXPECT_EQ(daemon.count("event=child_started"), 1u);
}

TEST_F(SupervisorTest, ABadConfigurationIsNotTriedAgain) {
    // The profile is read by the participant alone, the settings by both.
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--supervise", "--profile", "/nowhere.xml"},
          std::vector<std::string>{"--supervise", "--config", "/nowhere.yaml"}}) {
        ChildProcess daemon(GRASPD_PROGRAM, arguments);
        EXPECT_EQ(daemon.wait_exit(), 2);
        EXPECT_THAT(daemon.errors(), HasSubstr(arguments.back()));
        EXPECT_THAT(daemon.errors(), testing::Not(HasSubstr("event=child_died")));
    }
}

TEST_F(SupervisorTest, TheParticipantGoesWithAKilledSupervisor) {
    SupervisedDaemon daemon(test_domain());
    const pid_t participant = daemon.participant();
    EXPECT_THAT(test::process_state(participant), testing::Optional(testing::Ne('Z')));
    daemon.send_signal(SIGKILL);
    EXPECT_EQ(daemon.wait_exit(), -SIGKILL);
    EXPECT_TRUE(test::wait_gone(participant));
}

TEST_F(SupervisorTest, ChildrenThatItDidNotStartAreReaped) {
    // As process 1 of a container gets them. Here a shell starts one and then becomes the
    // supervisor.
    const std::string command = std::string("sleep 0.2 & exec ") + GRASPD_PROGRAM +
                                " --supervise --domain " + std::to_string(test_domain());
    ChildProcess daemon("/bin/sh", {"-c", command});
    ASSERT_TRUE(daemon.wait_for_error_text("event=ready")) << daemon.errors();
    const std::string log = daemon.errors();
    const std::string mark = "event=child_started pid=";
    const pid_t participant = std::stoi(log.substr(log.find(mark) + mark.size()));
    std::vector<pid_t> children;
    for (int i = 0; i < 100 && children != std::vector<pid_t>{participant}; ++i) {
        std::this_thread::sleep_for(50ms);
        children = test::children_of(daemon.id());
    }
    EXPECT_THAT(children, testing::ElementsAre(participant));
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
}

TEST_F(SupervisorTest, TheSharedMemoryOfTheDeadIsRemovedAndNoOther) {
    struct statvfs shm {};
    const bool known = ::statvfs("/dev/shm", &shm) == 0;
    if (!known || shm.f_bavail * shm.f_frsize < (std::uint64_t{320} << 20)) {
        GTEST_SKIP() << "/dev/shm has no room for three segments of 64 MB";
    }
    const std::vector<std::string> profile = {"--profile",
                                              GRASPD_SOURCE_DIR "/profiles/dds/shm.xml"};
    SupervisedDaemon daemon(test_domain(), profile);
    SupervisedDaemon other(test_domain() + 1, profile);
    const auto own = server::owned_segments(daemon.participant());
    const auto others = server::owned_segments(other.participant());
    ASSERT_EQ(own.size(), 1u);
    ASSERT_EQ(others.size(), 1u);
    std::this_thread::sleep_for(1500ms);  // longer than the supervisor looks away
    ::kill(daemon.participant(), SIGKILL);
    ASSERT_TRUE(daemon.wait_restarted(1)) << daemon.errors();
    EXPECT_FALSE(std::filesystem::exists(own[0])) << daemon.errors();
    EXPECT_TRUE(std::filesystem::exists(others[0]));
    for (SupervisedDaemon* each : {&daemon, &other}) {
        each->send_signal(SIGTERM);
        EXPECT_EQ(each->wait_exit(), 0);
    }
}

}  // namespace
}  // namespace graspd
