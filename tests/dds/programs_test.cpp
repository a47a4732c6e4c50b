#include <gmock/gmock.h>

#include <csignal>

#include "daemon_harness.hpp"
#include "graspd/config/version.hpp"

// The programs from outside: arguments, exit codes, and what they print.

namespace graspd {
namespace {

using test::ChildProcess;
using test::Daemon;
using test::daemon_domain;
using test::TemporaryFile;
using testing::AllOf;
using testing::HasSubstr;

/// graspd with arguments that make it leave at once: its exit code, and what it said.
std::pair<std::optional<int>, std::string> leaves(const std::vector<std::string>& arguments) {
    ChildProcess daemon(GRASPD_PROGRAM, arguments);
    const auto code = daemon.wait_exit();
    return {code, daemon.errors() + daemon.output()};
}

TEST(DaemonArguments, ABadConfigurationEndsWithTwoAndNamesKeyValueAndRange) {
    const TemporaryFile range("range.yaml", "server:\n  queue_capacity: 0\n");
    const TemporaryFile type("type.yaml", "server:\n  workers: many\n");
    const TemporaryFile unknown("unknown.yaml", "server:\n  threads: 2\n");
    const TemporaryFile planner("planner.yaml", "force_balance:\n  max_rms_m: -1\n");
    const auto out_of_range = leaves({"--config", range.path()});
    EXPECT_EQ(out_of_range.first, 2);
    EXPECT_THAT(out_of_range.second,
                AllOf(HasSubstr(range.path()), HasSubstr("server.queue_capacity = 0"),
                      HasSubstr("[1, 100000]")));
    const auto wrong_type = leaves({"--config", type.path()});
    EXPECT_EQ(wrong_type.first, 2);
    EXPECT_THAT(wrong_type.second,
                AllOf(HasSubstr("server.workers"), HasSubstr("many"), HasSubstr("[1, 256]")));
    const auto unknown_key = leaves({"--config", unknown.path()});
    EXPECT_EQ(unknown_key.first, 2);
    EXPECT_THAT(unknown_key.second, HasSubstr("server.threads"));
    const auto bad_planner = leaves({"--config", planner.path()});
    EXPECT_EQ(bad_planner.first, 2);
    EXPECT_THAT(bad_planner.second, HasSubstr("force_balance.max_rms_m = -1"));
}

TEST(DaemonArguments, BadOnesEndWithTwo) {
    EXPECT_EQ(leaves({"--domain", "233"}).first, 2);
    EXPECT_THAT(leaves({"--domain", "233"}).second, HasSubstr("--domain = 233 must be"));
    EXPECT_EQ(leaves({"--workers", "0"}).first, 2);
    EXPECT_EQ(leaves({"--log-level", "loud"}).first, 2);
    EXPECT_EQ(leaves({"--profile", "/nowhere.xml"}).first, 2);
    EXPECT_THAT(leaves({"--profile", "/nowhere.xml"}).second, HasSubstr("/nowhere.xml"));
    EXPECT_EQ(leaves({"--config", "/nowhere.yaml"}).first, 2);
    EXPECT_EQ(leaves({"--unheard-of"}).first, 2);
    const TemporaryFile profile("broken.xml", "<dds><profiles>");
    EXPECT_EQ(leaves({"--profile", profile.path()}).first, 2);
}

TEST(DaemonArguments, RosDomainIdIsHonoured) {
    ASSERT_EQ(::setenv("ROS_DOMAIN_ID", "400", 1), 0);
    const auto bad = leaves({});
    const std::string domain = std::to_string(daemon_domain(10));
    ASSERT_EQ(::setenv("ROS_DOMAIN_ID", domain.c_str(), 1), 0);
    ChildProcess daemon(GRASPD_PROGRAM, {});
    ASSERT_EQ(::unsetenv("ROS_DOMAIN_ID"), 0);
    EXPECT_EQ(bad.first, 2);
    EXPECT_THAT(bad.second, HasSubstr("ROS_DOMAIN_ID = 400 must be a whole number in [0, 232]"));
    EXPECT_TRUE(daemon.wait_for_error_text("event=ready domain=" + domain));
    EXPECT_THAT(daemon.errors(), HasSubstr("interfaces=127.0.0.1 "));
    daemon.send_signal(SIGINT);
    EXPECT_EQ(daemon.wait_exit(), 0);
    EXPECT_EQ(daemon.output(), "");  // the log goes to standard error
}

TEST(DaemonArguments, PrintConfigGivesAFileThatReadsBack) {
    const auto printed = leaves({"--print-config", "--workers", "3"});
    EXPECT_EQ(printed.first, 0);
    EXPECT_THAT(printed.second, HasSubstr("server:\n  workers: 3\n"));
    const TemporaryFile file("printed.yaml", printed.second);
    EXPECT_EQ(leaves({"--print-config", "--config", file.path()}).second, printed.second);
    EXPECT_EQ(leaves({"--version"}).second, std::string("graspd ") + version() + "\n");
    EXPECT_EQ(leaves({"--help"}).first, 0);
}

class ProgramsTest : public testing::Test {
protected:
    const TemporaryFile box_{"box.off", test::off_text(test::box({0.04, 0.06, 0.08}))};
};

TEST_F(ProgramsTest, GraspctlRequestPrintsWhatADaemonPlans) {
    const std::string domain = std::to_string(daemon_domain(11));
    const Daemon daemon(daemon_domain(11));
    ChildProcess json(GRASPCTL_PROGRAM, {"request", box_.path(), "--domain", domain, "--format",
                                         "json", "--frame", "shelf", "--top", "2"});
    EXPECT_EQ(json.wait_exit(), 0) << json.errors();
    EXPECT_THAT(json.output(),
                AllOf(HasSubstr("\"schema\": \"graspd/1\""), HasSubstr("\"status\": \"OK\""),
                      HasSubstr("\"frame_id\": \"shelf\"")));
    // A box of 86 mm in every direction is too wide for 85 mm: no grasp, exit code 3.
    const TemporaryFile wide("wide.off", test::off_text(test::box({0.086, 0.086, 0.086})));
    ChildProcess none(GRASPCTL_PROGRAM, {"request", wide.path(), "--domain", domain});
    EXPECT_EQ(none.wait_exit(), 3) << none.errors();
    EXPECT_THAT(none.errors(), HasSubstr("NO_GRASP"));
    // A line is no solid: INVALID_REQUEST, exit code 2.
    const TemporaryFile flat("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
    ChildProcess invalid(GRASPCTL_PROGRAM, {"request", flat.path(), "--domain", domain});
    EXPECT_EQ(invalid.wait_exit(), 2) << invalid.errors();
    EXPECT_THAT(invalid.errors(), HasSubstr("INVALID_REQUEST"));
}

TEST_F(ProgramsTest, GraspctlRequestWithoutADaemonEndsWithFour) {
    const std::string domain = std::to_string(daemon_domain(12));
    ChildProcess alone(GRASPCTL_PROGRAM, {"request", box_.path(), "--domain", domain, "--timeout",
                                          "200", "--retries", "0"});
    EXPECT_EQ(alone.wait_exit(), 4);
    EXPECT_THAT(alone.errors(), HasSubstr("no planner on domain " + domain + " within 200 ms"));
    ChildProcess wrong(GRASPCTL_PROGRAM, {"request", box_.path(), "--domain", "233"});
    EXPECT_EQ(wrong.wait_exit(), 2);
}

TEST_F(ProgramsTest, TheExamplesTalkToADaemon) {
    const std::string domain = std::to_string(daemon_domain(13));
    const Daemon daemon(daemon_domain(13));
    ChildProcess publisher(REQUEST_PUBLISHER_PROGRAM,
                           {box_.path(), "--id", "box-7", "--domain", domain});
    EXPECT_EQ(publisher.wait_exit(), 0) << publisher.errors();
    EXPECT_EQ(publisher.output(), "request box-7: 12 triangles sent\n");
    // Started after the request: replies are kept for late readers.
    ChildProcess subscriber(REPLY_SUBSCRIBER_PROGRAM,
                            {"--count", "1", "--timeout", "9", "--domain", domain});
    EXPECT_EQ(subscriber.wait_exit(), 0) << subscriber.errors();
    EXPECT_THAT(subscriber.output(),
                AllOf(HasSubstr("request box-7: OK, 10 grasps"), HasSubstr("rank  score")));
}

TEST_F(ProgramsTest, TheExamplesEndWithAMessageWhenThereIsNobody) {
    const std::string domain = std::to_string(daemon_domain(14));
    ChildProcess publisher(REQUEST_PUBLISHER_PROGRAM,
                           {box_.path(), "--timeout", "1", "--domain", domain});
    ChildProcess subscriber(REPLY_SUBSCRIBER_PROGRAM,
                            {"--count", "1", "--timeout", "1", "--domain", domain});
    EXPECT_EQ(publisher.wait_exit(), 1);
    EXPECT_THAT(publisher.errors(), HasSubstr("no planner was found"));
    EXPECT_EQ(subscriber.wait_exit(), 4);
    ChildProcess profile(REPLY_SUBSCRIBER_PROGRAM, {"--profile", "/nowhere.xml"});
    EXPECT_EQ(profile.wait_exit(), 1);
    EXPECT_THAT(profile.errors(), HasSubstr("/nowhere.xml"));
}

TEST_F(ProgramsTest, PlanOfflineNeedsNoDaemon) {
    ChildProcess plan(PLAN_OFFLINE_PROGRAM, {box_.path(), "robotiq_2f_85"});
    EXPECT_EQ(plan.wait_exit(), 0) << plan.errors();
    EXPECT_THAT(plan.output(), HasSubstr("OK"));
    ChildProcess unknown(PLAN_OFFLINE_PROGRAM, {box_.path(), "hook"});
    EXPECT_EQ(unknown.wait_exit(), 2);
}

}  // namespace
}  // namespace graspd
