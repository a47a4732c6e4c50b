#include <gmock/gmock.h>

#include "convert_basics.hpp"
#include "guid_bytes.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"

// MoveIt's service /plan_grasps on the wire, for callers of both ROS 2 vendors and of both layouts.

namespace graspd {
namespace {

using test::as_received;
using test::Bytes;
using test::no_grasp;
using test::payload_of;
using test::RawClient;
using test::SharedRequest;
using test::StubPlanner;
using test::verdict;
using test::with_header;
using JazzyResponse = moveit_msgs::srv::dds_::GraspPlanning_Response_;
using HumbleResponse = moveit_msgs_humble::srv::dds_::GraspPlanning_Response_;

/// The service's topics, with the volatile reader of a ROS 2 client.
test::RawTopics moveit_topics() {
    test::RawTopics topics{"rq/plan_graspsRequest",
                           "moveit_msgs::srv::dds_::GraspPlanning_Request_",
                           dds::kMoveItRequestEnds,
                           "rr/plan_graspsReply",
                           "moveit_msgs::srv::dds_::GraspPlanning_Response_",
                           dds::kMoveItReplyEnds};
    topics.reply_ends.transient_local = false;
    return topics;
}

DdsSettings moveit_settings(MoveItCodes codes = MoveItCodes::kJazzy) {
    DdsSettings settings = test::loopback_settings();
    settings.moveit.error_codes = codes;
    return settings;
}

/// A sphere in the frame "base".
moveit_msgs::srv::dds_::GraspPlanning_Request_ ball(const std::string& id) {
    moveit_msgs::srv::dds_::GraspPlanning_Request_ call;
    call.target().header().frame_id("base");
    call.target().id(id);
    call.target().pose(dds::write_pose(Eigen::Isometry3d::Identity()));
    auto& sphere = call.target().primitives().emplace_back();
    sphere.type(shape_msgs::msg::dds_::SolidPrimitive__Constants::SPHERE_);
    sphere.dimensions().push_back(0.02);
    return call;
}

/// One grasp of "hand", whose id says nothing of the call; or the reason why there is none.
std::unique_ptr<OutgoingReply> one_grasp(const SharedRequest& request) {
    auto reply = verdict(request, PlanStatus::kOk, "");
    Grasp& grasp = reply->reply.grasps.emplace_back();
    grasp.X_FH.translation() << 1, 2, 3;
    grasp.approach = {Eigen::Vector3d::UnitX(), 0.5};
    grasp.retreat = {Eigen::Vector3d::UnitZ(), 0.25};
    grasp.score = 0.5;
    return reply;
}

moveit_msgs::msg::dds_::GripperTranslation_ moved(const Eigen::Vector3d& direction,
                                                  float distance) {
    moveit_msgs::msg::dds_::GripperTranslation_ out;
    out.direction().header().frame_id("base");
    out.direction().vector(dds::write_vector(direction));
    out.desired_distance(distance);
    out.min_distance(0.5f * distance);
    return out;
}

/// What the planner must have written, put together here from the types alone.
template <class Response>
Response expected(std::int32_t code, const std::string& message, const std::string& target) {
    Response out;
    out.error_code().val(code);
    if constexpr (requires { out.error_code().message(); }) {
        out.error_code().message(message);
        out.error_code().source("graspd");
    }
    if (target.empty()) return out;
    auto& grasp = out.grasps().emplace_back();
    grasp.id("grasp_1");
    grasp.grasp_pose().header().frame_id("base");
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 1, 2, 3;
    grasp.grasp_pose().pose(dds::write_pose(pose));
    grasp.grasp_quality(0.5);
    grasp.pre_grasp_approach(moved(Eigen::Vector3d::UnitX(), 0.5f));
    grasp.post_grasp_retreat(moved(Eigen::Vector3d::UnitZ(), 0.25f));
    grasp.post_place_retreat(moved(-Eigen::Vector3d::UnitX(), 0.5f));
    grasp.max_contact_force(20.0f);
    grasp.allowed_touch_objects().push_back(target);
    return out;
}

template <class Response>
void expect_both_styles(MoveItCodes codes) {
    StubPlanner planner(one_grasp, moveit_settings(codes));
    RawClient caller(moveit_topics());
    ASSERT_TRUE(caller.wait_matched());
    const Bytes plain = payload_of(ball("ball"));
    const Bytes wanted = payload_of(expected<Response>(1, "", "ball"));
    ASSERT_EQ(caller.call(plain), 1u);  // rmw_fastrtps
    ASSERT_EQ(caller.wait_for(1).size(), 1u);
    ASSERT_TRUE(caller.write(with_header(plain, 0x0123456789abcdefu, 77)));  // rmw_cyclonedds
    const auto replies = caller.wait_for_samples(2);
    ASSERT_EQ(replies.size(), 2u);
    EXPECT_EQ(replies[0].related.writer_guid(), caller.reader().guid());
    EXPECT_EQ(replies[0].related.sequence_number().to64long(), 1u);
    EXPECT_EQ(replies[0].payload, as_received(wanted));
    EXPECT_EQ(replies[1].payload, as_received(with_header(wanted, 0x0123456789abcdefu, 77)));
}

TEST(MoveItService, AnswersBothVendorsInTheLayoutOfJazzy) {
    expect_both_styles<JazzyResponse>(MoveItCodes::kJazzy);
}

TEST(MoveItService, AnswersBothVendorsInTheLayoutOfHumble) {
    expect_both_styles<HumbleResponse>(MoveItCodes::kHumble);
}

TEST(MoveItService, SaysWhyThereIsNoGrasp) {
    StubPlanner planner(no_grasp, moveit_settings());
    RawClient caller(moveit_topics());
    ASSERT_TRUE(caller.wait_matched());
    ASSERT_EQ(caller.call(payload_of(ball("ball"))), 1u);
    const auto replies = caller.wait_for(1);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0], as_received(payload_of(expected<JazzyResponse>(-1, "none", ""))));
}

// A call is a request like any other: who asked, under which name, for what; the same bytes again
// are another call.
TEST(MoveItService, EveryCallIsARequestOfItsOwn) {
    StubPlanner planner(no_grasp, moveit_settings());
    RawClient caller(moveit_topics());
    ASSERT_TRUE(caller.wait_matched());
    const Bytes plain = payload_of(ball("ball"));
    ASSERT_NE(caller.call(plain), 0u);
    ASSERT_NE(caller.call(plain), 0u);
    const auto requests = planner.wait_for(2);
    ASSERT_EQ(requests.size(), 2u);
    EXPECT_EQ(requests[0]->identity().writer, dds::bytes_of(caller.writer().guid()));
    EXPECT_EQ(requests[0]->identity().request_id, "moveit-1");
    EXPECT_EQ(requests[1]->identity().request_id, "moveit-2");
    EXPECT_EQ(requests[0]->identity().payload_hash, requests[1]->identity().payload_hash);
    EXPECT_EQ(requests[0]->frame_id(), "base");
    EXPECT_EQ(requests[0]->object_key(), "");
    Gripper gripper;
    gripper.name = "hand";
    const auto request = requests[0]->convert(std::vector{gripper});
    ASSERT_TRUE(request.ok()) << request.error().detail;
    EXPECT_EQ(std::get<TriangleMesh>(request.value().object_O).faces.size(), 3968u);
}

TEST(MoveItService, MalformedCallsAreRefusedAndCounted) {
    StubPlanner planner(no_grasp, moveit_settings());
    RawClient caller(moveit_topics());
    ASSERT_TRUE(caller.wait_matched());
    const Bytes plain = payload_of(ball("ball"));
    const Bytes cut(plain.begin(), plain.end() - 8);
    Bytes huge = plain;
    std::fill_n(huge.begin() + 4, 4, std::uint8_t{0xff});  // group_name's length
    ASSERT_NE(caller.call(cut), 0u);
    ASSERT_NE(caller.call(huge), 0u);
    ASSERT_TRUE(caller.write(with_header(cut, 1, 2)));
    ASSERT_TRUE(caller.write({0, 1, 0, 0, 1, 2, 3, 4}));
    ASSERT_NE(caller.call(plain), 0u);
    ASSERT_EQ(caller.wait_for(1).size(), 1u);
    EXPECT_EQ(planner.wait_for(1).size(), 1u);
    EXPECT_EQ(planner.port().rejected_payloads(), 4u);
}

// The caller is told, as MoveIt tells it: an error code and why.
TEST(MoveItService, ACallAboveTheCapIsAnswered) {
    auto large = ball("large");
    for (int i = 0; i < 100; ++i) large.movable_obstacles().push_back(large.target());
    DdsSettings settings = moveit_settings();
    settings.max_payload_bytes = static_cast<std::uint32_t>(payload_of(ball("ball")).size()) + 100;
    StubPlanner planner(no_grasp, settings);
    RawClient caller(moveit_topics());
    ASSERT_TRUE(caller.wait_matched());
    ASSERT_NE(caller.call(payload_of(large)), 0u);
    ASSERT_EQ(caller.wait_for(1).size(), 1u);
    const auto requests = planner.wait_for(1);
    ASSERT_EQ(requests.size(), 1u);
    const auto refused = requests[0]->convert({});
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().detail, testing::HasSubstr("server.max_payload_bytes"));
    EXPECT_EQ(planner.port().rejected_payloads(), 0u);
}

TEST(MoveItService, MayBeOff) {
    StubPlanner planner(no_grasp, moveit_settings(MoveItCodes::kOff));
    RawClient asks_the_planner(test::service_topics());
    RawClient caller(moveit_topics());
    ASSERT_TRUE(asks_the_planner.wait_matched());
    {
        // By the time the caller has found this planner, it would have found the one before it.
        StubPlanner another(no_grasp, moveit_settings());
        ASSERT_TRUE(caller.wait_matched());
    }
    EXPECT_TRUE(caller.wait_alone());
}

}  // namespace
}  // namespace graspd
