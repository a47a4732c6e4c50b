#include "ros_graph.hpp"

#include <gmock/gmock.h>

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include "cdr_bytes.hpp"
#include "raw_endpoints.hpp"
#include "stub_planner.hpp"
#include "type_hashes.hpp"
#include "wire_types.hpp"

namespace graspd {
namespace {

using test::Bytes;
using test::loopback_settings;
using test::no_answer;
using test::RawClient;
using test::SharedRequest;
using test::StubPlanner;
using testing::SizeIs;
namespace now = rmw_dds_common::msg::dds_;
namespace old = rmw_dds_common_gid24::msg::dds_;

constexpr const char* kType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
constexpr const char* kOldType = "rmw_dds_common_gid24::msg::dds_::ParticipantEntitiesInfo_";

DdsSettings node_settings(GidBytes gid_bytes) {
    DdsSettings settings = loopback_settings();
    settings.node = {"planner", "/cell1", "/", gid_bytes};
    return settings;
}

/// The graph's topic as another participant sees it.
test::RawTopics graph_topics() {
    dds::Contract reader = dds::kGraphEnds;
    reader.depth = 0;
    return {"ros_discovery_info", kType, dds::kGraphEnds, "ros_discovery_info", kType, reader};
}

template <class Info>
Info parsed(Bytes payload, const char* type) {
    Info info;
    EXPECT_TRUE(dds::read_cdr(payload, *dds::wire_layouts().find(type), info));
    return info;
}

// Readers: requests, cancellations, service calls. Writers: replies, status, diagnostics, markers,
// service.
TEST(RosGraph, AnnouncesTheNodeWithItsEndpoints) {
    StubPlanner planner(no_answer, node_settings(GidBytes::k16));
    RawClient tool(graph_topics());
    const auto seen = tool.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    EXPECT_EQ(dds::gid_bytes_of(seen[0]), GidBytes::k16);
    const auto info = parsed<now::ParticipantEntitiesInfo_>(seen[0], kType);
    ASSERT_THAT(info.node_entities_info_seq(), SizeIs(1));
    const auto& node = info.node_entities_info_seq()[0];
    EXPECT_EQ(node.node_name(), "planner");
    EXPECT_EQ(node.node_namespace(), "/cell1");
    EXPECT_THAT(node.reader_gid_seq(), SizeIs(3));
    EXPECT_THAT(node.writer_gid_seq(), SizeIs(5));
    for (const auto& gid : node.writer_gid_seq()) {
        EXPECT_TRUE(std::equal(gid.data().begin(), gid.data().begin() + 12,
                               info.gid().data().begin()));  // of this participant
        EXPECT_EQ(gid.data()[15], 0x03);                     // RTPS: a user's writer without key
    }
    for (const auto& gid : node.reader_gid_seq()) EXPECT_EQ(gid.data()[15], 0x04);
    EXPECT_EQ(info.gid().data()[15], 0xc1);  // RTPS: a participant
}

TEST(RosGraph, LeavesOutMarkersThatAreOff) {
    DdsSettings settings = node_settings(GidBytes::k16);
    settings.markers = false;
    StubPlanner planner(no_answer, settings);
    RawClient tool(graph_topics());
    const auto seen = tool.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    const auto info = parsed<now::ParticipantEntitiesInfo_>(seen[0], kType);
    ASSERT_THAT(info.node_entities_info_seq(), SizeIs(1));
    EXPECT_THAT(info.node_entities_info_seq()[0].writer_gid_seq(), SizeIs(4));
    EXPECT_FALSE(planner.port().write_markers({}, {}));
}

// One reader and one writer more.
TEST(RosGraph, AnnouncesTheServiceForMoveIt) {
    DdsSettings settings = node_settings(GidBytes::k16);
    settings.moveit.error_codes = MoveItCodes::kHumble;
    StubPlanner planner(no_answer, settings);
    RawClient tool(graph_topics());
    const auto seen = tool.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    const auto info = parsed<now::ParticipantEntitiesInfo_>(seen[0], kType);
    ASSERT_THAT(info.node_entities_info_seq(), SizeIs(1));
    EXPECT_THAT(info.node_entities_info_seq()[0].reader_gid_seq(), SizeIs(4));
    EXPECT_THAT(info.node_entities_info_seq()[0].writer_gid_seq(), SizeIs(6));
}

TEST(RosGraph, SpeaksTheOldLayoutWhenTold) {
    StubPlanner planner(no_answer, node_settings(GidBytes::k24));
    RawClient tool(graph_topics());
    const auto seen = tool.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    EXPECT_EQ(dds::gid_bytes_of(seen[0]), GidBytes::k24);
    const auto info = parsed<old::ParticipantEntitiesInfo_>(seen[0], kOldType);
    ASSERT_THAT(info.node_entities_info_seq(), SizeIs(1));
    EXPECT_EQ(info.node_entities_info_seq()[0].node_name(), "planner");
    for (std::size_t i = 16; i < 24; ++i) EXPECT_EQ(info.gid().data()[i], 0);
}

/// What a ROS 2 process says of itself before it has any node.
template <class Info>
Bytes empty_announcement() {
    Info info;
    info.gid().data()[0] = 1;
    return dds::cdr_bytes(info);
}

class RosGraphAuto : public testing::TestWithParam<GidBytes> {};

// Nobody hears of the node before another one has shown which layout this domain speaks.
TEST_P(RosGraphAuto, SpeaksAsTheFirstNodeThatItHears) {
    StubPlanner planner(no_answer, node_settings(GidBytes::kAuto));
    RawClient tool(graph_topics());
    ASSERT_TRUE(tool.wait_matched());
    const Bytes own = GetParam() == GidBytes::k16
                          ? empty_announcement<now::ParticipantEntitiesInfo_>()
                          : empty_announcement<old::ParticipantEntitiesInfo_>();
    ASSERT_TRUE(tool.write({0, 1, 0, 0, 7, 7}));  // of neither layout: decides nothing
    ASSERT_TRUE(tool.write(own));
    std::vector<Bytes> seen;
    for (std::size_t count = 1; count <= 3; ++count) {
        for (const Bytes& payload : tool.wait_for(count)) {
            if (payload != own && payload.size() > 30) seen.push_back(payload);
        }
        if (!seen.empty()) break;
    }
    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(dds::gid_bytes_of(seen[0]), GetParam());
}
INSTANTIATE_TEST_SUITE_P(Layouts, RosGraphAuto, testing::Values(GidBytes::k16, GidBytes::k24));

TEST(RosGraph, LayoutOfAPayload) {
    EXPECT_EQ(dds::gid_bytes_of(empty_announcement<now::ParticipantEntitiesInfo_>()),
              GidBytes::k16);
    EXPECT_EQ(dds::gid_bytes_of(empty_announcement<old::ParticipantEntitiesInfo_>()),
              GidBytes::k24);
    EXPECT_EQ(dds::gid_bytes_of(Bytes{0, 1, 0, 0}), GidBytes::kAuto);
    EXPECT_EQ(dds::gid_bytes_of(Bytes(200, 0xff)), GidBytes::kAuto);
}

/// What the middleware tells of another participant and its endpoints.
class Discovery final : public dds::fast::DomainParticipantListener {
public:
    void on_participant_discovery(
        dds::fast::DomainParticipant*,
        eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
        const auto& data = info.info.m_userData;
        note(std::string(data.begin(), data.end()));
    }
    void on_publisher_discovery(dds::fast::DomainParticipant*,
                                eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
        const auto& data = info.info.m_qos.m_userData;
        note(info.info.topicName().to_string() + " " + std::string(data.begin(), data.end()));
    }
    void on_subscriber_discovery(dds::fast::DomainParticipant*,
                                 eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override {
        const auto& data = info.info.m_qos.m_userData;
        note(info.info.topicName().to_string() + " " + std::string(data.begin(), data.end()));
    }
    bool wait_for(const std::string& text) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(10),
                                 [&] { return std::ranges::count(seen_, text) > 0; });
    }

private:
    void note(std::string text) {
        const std::lock_guard lock(mutex_);
        seen_.push_back(std::move(text));
        changed_.notify_all();
    }
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> seen_;
};

// ROS 2's tools read the enclave off the participant, and from Iron on each type's hash off its
// endpoints.
TEST(RosGraph, ParticipantAndEndpointsCarryWhatToolsRead) {
    DdsSettings settings = node_settings(GidBytes::k16);
    settings.node.enclave = "/cell/planner";
    settings.moveit.error_codes = MoveItCodes::kJazzy;
    Discovery discovery;
    auto& factory = *dds::fast::DomainParticipantFactory::get_instance();
    ASSERT_EQ(factory.load_XML_profiles_file(settings.profile_file), test::ReturnCode::RETCODE_OK);
    auto* tool =
        factory.create_participant_with_profile(settings.domain, "graspd_participant", &discovery);
    ASSERT_NE(tool, nullptr);
    {
        StubPlanner planner(no_answer, settings);
        EXPECT_TRUE(discovery.wait_for("enclave=/cell/planner;"));
        const auto hash = [](const std::string& type) {
            return " typehash=" + std::string(dds::type_hash(type)) + ";";
        };
        ASSERT_FALSE(dds::type_hash("graspd_msgs::msg::dds_::GraspRequest_").empty());
        EXPECT_TRUE(discovery.wait_for("rt/graspd/grasp_request" +
                                       hash("graspd_msgs::msg::dds_::GraspRequest_")));
        EXPECT_TRUE(discovery.wait_for("rt/graspd/ranked_grasps" +
                                       hash("graspd_msgs::msg::dds_::RankedGrasps_")));
        EXPECT_TRUE(discovery.wait_for("rt/graspd/markers" +
                                       hash("visualization_msgs::msg::dds_::MarkerArray_")));
        EXPECT_TRUE(discovery.wait_for("rr/graspd/plan_graspsReply" +
                                       hash("graspd_msgs::srv::dds_::PlanGrasps_Response_")));
        EXPECT_TRUE(discovery.wait_for("rq/plan_graspsRequest" +
                                       hash("moveit_msgs::srv::dds_::GraspPlanning_Request_")));
        EXPECT_TRUE(discovery.wait_for("rr/plan_graspsReply" +
                                       hash("moveit_msgs::srv::dds_::GraspPlanning_Response_")));
    }
    {
        // Humble has no hashes, and Jazzy's would be that of another layout.
        settings.moveit.error_codes = MoveItCodes::kHumble;
        StubPlanner planner(no_answer, settings);
        EXPECT_TRUE(discovery.wait_for("rr/plan_graspsReply "));
    }
    factory.delete_participant(tool);
}

}  // namespace
}  // namespace graspd
