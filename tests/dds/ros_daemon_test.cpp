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

/// The topics of MoveIt's service, with the volatile reader of a ROS 2 client.
test::RawTopics moveit_topics(const std::string& name_space) {
    test::RawTopics topics{"rq" + name_space + "/plan_graspsRequest",
                           "moveit_msgs::srv::dds_::GraspPlanning_Request_",
                           dds::kMoveItRequestEnds,
                           "rr" + name_space + "/plan_graspsReply",
                           "moveit_msgs::srv::dds_::GraspPlanning_Response_",
                           dds::kMoveItReplyEnds};
    topics.reply_ends.transient_local = false;
    return topics;
}

/// Calls with a box of 40 x 60 x 80 mm that stands on a table.
moveit_msgs::srv::dds_::GraspPlanning_Response_ call_moveit(test::RawClient& caller,
                                                            const std::string& group) {
    moveit_msgs::srv::dds_::GraspPlanning_Request_ call;
    call.group_name(group);
    call.target().header().frame_id("base");
    call.target().id("block");
    call.target().pose().position().z(0.04);
    call.target().pose().orientation().w(1.0);
    auto& box = call.target().primitives().emplace_back();
    box.type(shape_msgs::msg::dds_::SolidPrimitive__Constants::BOX_);
    box.dimensions({0.04, 0.06, 0.08});
    auto& table = call.movable_obstacles().emplace_back();
    table.id("table");
    table.pose().orientation().w(1.0);
    table.planes().emplace_back().coef({0.0, 0.0, 1.0, 0.0});
    call.support_surfaces().push_back("table");
    EXPECT_NE(caller.call(test::payload_of(call)), 0u);
    moveit_msgs::srv::dds_::GraspPlanning_Response_ response;
    const auto replies = caller.wait_for_samples(1);
    EXPECT_EQ(replies.size(), 1u);
    if (replies.empty()) return response;
    test::Bytes payload = replies.back().payload;
    EXPECT_TRUE(dds::read_cdr(
        payload, *dds::wire_layouts().find("moveit_msgs::srv::dds_::GraspPlanning_Response_"),
        response));
    return response;
}

// From the call to grasps that MoveIt can execute, of Franka's hand on its link 8.
TEST_F(RosDaemon, PlansForMoveIt) {
    const std::uint32_t domain = test::test_domain();
    Daemon daemon(domain, {"--ros-args", "-r", "__ns:=/cell1"});
    test::RawClient caller(moveit_topics("/cell1"), test::client_settings(domain));
    ASSERT_TRUE(caller.wait_matched());
    const auto response = call_moveit(caller, "franka_hand");
    EXPECT_EQ(response.error_code().val(), 1) << response.error_code().message();
    EXPECT_EQ(response.error_code().source(), "graspd");
    ASSERT_FALSE(response.grasps().empty());
    double last = 1.0;
    for (const auto& grasp : response.grasps()) {
        EXPECT_EQ(grasp.grasp_pose().header().frame_id(), "base");
        EXPECT_GT(grasp.grasp_pose().pose().position().z(), 0.0);  // above the table
        EXPECT_LE(grasp.grasp_quality(), last);
        last = grasp.grasp_quality();
        ASSERT_EQ(grasp.grasp_posture().points().size(), 1u);
        const auto& at_contact = grasp.grasp_posture().points()[0].positions();
        const auto& before = grasp.pre_grasp_posture().points().at(0).positions();
        ASSERT_EQ(at_contact.size(), 2u);
        EXPECT_GE(at_contact[0], 0.02 - 1e-6);  // half the block's narrowest side
        EXPECT_GT(before[0], at_contact[0]);
        EXPECT_LE(before[0], 0.04);
    }
    EXPECT_EQ(response.grasps()[0].post_grasp_retreat().direction().vector().z(), 1.0);
}

TEST_F(RosDaemon, TellsMoveItWhichGrippersThereAre) {
    const std::uint32_t domain = test::test_domain();
    Daemon daemon(domain);
    test::RawClient caller(moveit_topics(""), test::client_settings(domain));
    ASSERT_TRUE(caller.wait_matched());
    const auto response = call_moveit(caller, "panda_arm");
    EXPECT_EQ(response.error_code().val(), -15);
    EXPECT_TRUE(response.grasps().empty());
    EXPECT_THAT(response.error_code().message(),
                AllOf(HasSubstr("group_name = \"panda_arm\""), HasSubstr("franka_hand")));
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
    EXPECT_THAT(leaves({"--ros-args", "-p", "ros.moveit_gripper:=hook"}),
                AllOf(HasSubstr("ros.moveit_gripper = hook"), HasSubstr("parallel_85")));
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
