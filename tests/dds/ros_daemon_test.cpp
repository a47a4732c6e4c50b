#include <gmock/gmock.h>

#include <csignal>

#include "daemon_harness.hpp"
#include "graspd/dds/planner_client.hpp"
#include "raw_endpoints.hpp"
#include "wire_client.hpp"

// graspd as ROS 2 users start and steer it.

namespace graspd {
namespace {

using namespace std::chrono_literals;
using test::ChildProcess;
using test::Daemon;
using test::daemon_domain;
using test::TemporaryFile;
using testing::AllOf;
using testing::HasSubstr;

class RosDaemon : public testing::Test {
protected:
    const TemporaryFile box_{"box.off", test::off_text(test::box({0.04, 0.06, 0.08}))};
};

// Namespace, node name and parameters as `ros2 run` passes them on.
TEST_F(RosDaemon, MovesWithItsNamespace) {
    const std::string domain = std::to_string(daemon_domain(14));
    const TemporaryFile file("params.yaml",
                             "/**:\n  ros__parameters:\n    server: {workers: 3}\n"
                             "    use_sim_time: true\n");
    Daemon daemon(daemon_domain(14),
                  {"--ros-args", "-r", "__ns:=/cell1", "-r", "__node:=planner", "--params-file",
                   file.path(), "-p", "server.queue_capacity:=5", "--"});
    EXPECT_THAT(daemon.errors(), AllOf(HasSubstr("node=/cell1/planner"), HasSubstr("workers=3"),
                                       HasSubstr("queue_capacity=5"),
                                       HasSubstr("request_topic=rt/cell1/graspd/grasp_request")));
    ChildProcess request(GRASPCTL_PROGRAM, {"request", box_.path(), "--domain", domain,
                                            "--namespace", "/cell1", "--format", "json"});
    EXPECT_EQ(request.wait_exit(), 0) << request.errors();
    EXPECT_THAT(request.output(), HasSubstr("\"status\": \"OK\""));
    ChildProcess status(GRASPCTL_PROGRAM, {"status", "--domain", domain, "--namespace", "/cell1",
                                           "--format", "json"});
    EXPECT_EQ(status.wait_exit(), 0) << status.errors();
    EXPECT_THAT(status.output(),
                AllOf(HasSubstr("\"queue_capacity\": 5"), HasSubstr("\"workers\": 3"),
                      HasSubstr("\"state\": \"READY\""), HasSubstr("\"OK\": 1")));
    ChildProcess elsewhere(GRASPCTL_PROGRAM, {"status", "--domain", domain, "--timeout", "1500"});
    EXPECT_EQ(elsewhere.wait_exit(), 4);
    EXPECT_THAT(elsewhere.errors(), HasSubstr("no planner on domain " + domain));
}

TEST_F(RosDaemon, ATopicIsRemappedByItself) {
    Daemon daemon(daemon_domain(15), {"--ros-args", "-r", "graspd/grasp_request:=/jobs"});
    EXPECT_THAT(daemon.errors(), HasSubstr("request_topic=rt/jobs"));
    DdsSettings settings = test::client_settings(daemon_domain(15));
    settings.names.grasp_request = "rt/jobs";
    auto client = PlannerClient::open(settings, "client");
    ASSERT_TRUE(client.ok());
    const auto reply = client.value()->request(test::box_request("jobs"), 10s, 0);
    ASSERT_TRUE(reply.ok()) << reply.error().detail;
    EXPECT_EQ(reply.value().status, PlanStatus::kOk);
}

TEST_F(RosDaemon, WrongRosArgumentsEndWithTwo) {
    const auto leaves = [](const std::vector<std::string>& arguments) {
        ChildProcess daemon(GRASPD_PROGRAM, arguments);
        const auto code = daemon.wait_exit();
        EXPECT_EQ(code, 2);
        return daemon.errors();
    };
    EXPECT_THAT(leaves({"--ros-args", "-r", "__ns:=cell 1"}), HasSubstr("cell 1"));
    EXPECT_THAT(leaves({"--ros-args", "-p", "server.wokers:=3"}), HasSubstr("server.wokers"));
    EXPECT_THAT(leaves({"--ros-args", "-p", "server.workers:=many"}),
                AllOf(HasSubstr("server.workers = many"), HasSubstr("[1, 256]")));
    EXPECT_THAT(leaves({"--ros-args", "-p", "server.workers:=0"}), HasSubstr("server.workers = 0"));
    EXPECT_THAT(leaves({"--ros-args", "-p", "ros.gid_bytes:=32"}), HasSubstr("gid_bytes = 32"));
    EXPECT_THAT(leaves({"--ros-args", "--params-file", "/nowhere.yaml"}),
                HasSubstr("/nowhere.yaml"));
}

TEST_F(RosDaemon, ACancelledRequestIsAnsweredWhileItIsPlanned) {
    const std::uint32_t domain = daemon_domain(16);
    Daemon daemon(domain);
    const DdsSettings settings = test::client_settings(domain);
    test::WireClient client(settings);
    test::RawTopics topics;
    topics.request = "rt/graspd/cancel";
    topics.request_type = "graspd_msgs::msg::dds_::CancelRequest_";
    topics.request_ends = dds::kCancelEnds;
    test::RawClient canceller(topics, settings);
    ASSERT_TRUE(client.wait_matched());
    ASSERT_TRUE(canceller.wait_matched());
    client.send(test::long_request("long"));
    ASSERT_TRUE(daemon.wait_for_error_text("event=planning id=long"));
    dds::wire::CancelRequest_ order;
    order.client_id("wire");
    order.request_id("long");
    ASSERT_TRUE(canceller.write(test::payload_of(order)));
    const auto replies = client.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0].status(), static_cast<int>(PlanStatus::kCancelled));
    EXPECT_EQ(replies[0].message(), "cancelled by its client");
    EXPECT_TRUE(daemon.wait_for_error_text("event=cancel id=long"));
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
}

// The status tells that the planner goes, and that nobody is left to tell after that.
TEST_F(RosDaemon, StatusTableNamesThePlanner) {
    const std::string domain = std::to_string(daemon_domain(17));
    const Daemon daemon(daemon_domain(17));
    ChildProcess status(GRASPCTL_PROGRAM, {"status", "--domain", domain});
    EXPECT_EQ(status.wait_exit(), 0) << status.errors();
    EXPECT_THAT(status.output(), AllOf(HasSubstr("planner"), HasSubstr("READY"), HasSubstr("0/16"),
                                       HasSubstr("0/2")));
}

}  // namespace
}  // namespace graspd
