#include <gmock/gmock.h>

#include <csignal>
#include <map>

#include "convert_reply.hpp"
#include "daemon_harness.hpp"
#include "raw_endpoints.hpp"
#include "wire_client.hpp"

// Pictures as a viewer gets them from graspd itself.

namespace graspd {
namespace {

using test::client_settings;
using test::Daemon;
using test::RawClient;
using test::TemporaryFile;
using test::test_domain;
using test::WireClient;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using visualization_msgs::msg::dds_::Marker_;
using visualization_msgs::msg::dds_::MarkerArray_;

constexpr const char* kType = "visualization_msgs::msg::dds_::MarkerArray_";

/// Reads pictures; its writer is of no use but to know when requests are heard.
test::RawTopics viewer_topics() {
    test::RawTopics topics;
    topics.reply = "rt/graspd/markers";
    topics.reply_type = kType;
    topics.reply_ends = dds::kMarkersEnds;
    return topics;
}

MarkerArray_ parsed(test::Bytes payload) {
    MarkerArray_ array;
    EXPECT_TRUE(dds::read_cdr(payload, *dds::wire_layouts().find(kType), array));
    return array;
}

std::map<std::string, std::vector<Marker_>> by_namespace(const MarkerArray_& array) {
    std::map<std::string, std::vector<Marker_>> sorted;
    for (const Marker_& marker : array.markers()) sorted[marker.ns()].push_back(marker);
    return sorted;
}

/// A cup of 60 mm, whose inside is concave.
PlanRequest cup_request(const std::string& id, bool markers) {
    PlanRequest request = test::box_request(id);
    request.object_O = test::cup(0.03, 0.08, 0.004, 2000);
    request.options.want_markers = markers;
    return request;
}

// The viewer starts when the plan has long been answered: transient local.
TEST(Markers, ALateViewerSeesThePlan) {
    const std::uint32_t domain = test_domain();
    Daemon daemon(domain);
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    auto request = dds::write_request(cup_request("cup", true), "wire").value();
    request.header().stamp().sec(17);
    client.send(request);
    const auto replies = client.wait_for(1);
    ASSERT_THAT(replies, SizeIs(1));
    ASSERT_TRUE(daemon.wait_for_error_text("event=drawn id=cup"));

    RawClient viewer(viewer_topics(), client_settings(domain));
    const auto seen = viewer.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    const MarkerArray_ array = parsed(seen[0]);
    EXPECT_EQ(array.markers().at(0).action(), 3);  // DELETEALL
    for (const Marker_& marker : array.markers()) {
        EXPECT_EQ(marker.header().frame_id(), "table");
        EXPECT_EQ(marker.header().stamp().sec(), 17);
    }
    const std::size_t hands = replies[0].grasps().size();
    ASSERT_GT(hands, 0u);
    auto kinds = by_namespace(array);
    EXPECT_THAT(kinds, SizeIs(6));
    ASSERT_THAT(kinds["object"], SizeIs(1));
    EXPECT_GE(kinds["object"][0].points().size(), 3 * 1000u);
    EXPECT_EQ(kinds["object"][0].colors().size(), kinds["object"][0].points().size());
    EXPECT_GE(kinds["regions"].size(), 1u);
    EXPECT_THAT(kinds["grippers"], SizeIs(3 * hands));  // parallel_85 is three boxes
    ASSERT_THAT(kinds["contacts"], SizeIs(1));
    EXPECT_THAT(kinds["contacts"][0].points(), SizeIs(2 * hands));
    ASSERT_THAT(kinds["labels"], SizeIs(hands));
    const auto& best = replies[0].grasps()[0];
    EXPECT_EQ(kinds["contacts"][0].points()[0].x(), best.contacts()[0].point().x());
    EXPECT_EQ(kinds["labels"][0].pose().position().z(), best.hand_pose().position().z());
}

// Pictures follow one another in the order of their plans, so the plain one would have come first.
TEST(Markers, NothingIsSentWithoutTheFlag) {
    const std::uint32_t domain = test_domain();
    Daemon daemon(domain);
    RawClient viewer(viewer_topics(), client_settings(domain));
    WireClient client(client_settings(domain));
    ASSERT_TRUE(viewer.wait_matched());
    ASSERT_TRUE(client.wait_matched());
    PlanRequest plain = cup_request("plain", false);
    plain.frame_id = "plain";
    client.send(plain);
    ASSERT_THAT(client.wait_for(1), SizeIs(1));
    PlanRequest drawn = cup_request("drawn", true);
    drawn.frame_id = "drawn";
    client.send(drawn);
    const auto replies = client.wait_for(2);
    ASSERT_THAT(replies, SizeIs(2));
    const auto seen = viewer.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    EXPECT_EQ(parsed(seen[0]).markers().at(0).header().frame_id(), "drawn");
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait_exit(), 0);
    EXPECT_THAT(daemon.errors(), HasSubstr("event=drawn id=drawn"));
    EXPECT_THAT(daemon.errors(), Not(HasSubstr("id=plain faces")));
    EXPECT_EQ(viewer.wait_for(1).size(), 1u);
    // The flag changes nothing else.
    EXPECT_EQ(replies[0].grasps().size(), replies[1].grasps().size());
    EXPECT_EQ(replies[0].grasps().at(0).score(), replies[1].grasps().at(0).score());
}

// Of 70,000 faces 20,000 at most are drawn; the reply comes as ever.
TEST(Markers, ALargeObjectIsDrawnCoarser) {
    const std::uint32_t domain = test_domain();
    Daemon daemon(domain);
    RawClient viewer(viewer_topics(), client_settings(domain));
    WireClient client(client_settings(domain));
    ASSERT_TRUE(viewer.wait_matched());
    ASSERT_TRUE(client.wait_matched());
    PlanRequest request = cup_request("large", true);
    request.object_O = test::torus(0.05, 0.015, 70000);
    client.send(request);
    const auto replies = client.wait_for(1);
    ASSERT_THAT(replies, SizeIs(1));
    EXPECT_EQ(replies[0].status(), static_cast<int>(PlanStatus::kOk)) << replies[0].message();
    const auto seen = viewer.wait_for(1);
    ASSERT_THAT(seen, SizeIs(1));
    const auto object = by_namespace(parsed(seen[0]))["object"];
    ASSERT_THAT(object, SizeIs(1));
    EXPECT_LE(object[0].points().size(), 3 * 20000u);
    EXPECT_GT(object[0].points().size(), 3 * 5000u);
}

TEST(Markers, TheSettingsMayForbidOrOrderThem) {
    const std::uint32_t domain = test_domain();
    {
        const TemporaryFile never("never.yaml", "server:\n  markers: never\n");
        Daemon daemon(domain, {"--config", never.path()});
        WireClient client(client_settings(domain));
        ASSERT_TRUE(client.wait_matched());
        client.send(cup_request("refused", true));
        const auto replies = client.wait_for(1);
        ASSERT_THAT(replies, SizeIs(1));
        EXPECT_EQ(replies[0].status(), static_cast<int>(PlanStatus::kInvalidRequest));
        EXPECT_THAT(replies[0].message(), HasSubstr("server.markers = never"));
    }
    const TemporaryFile always("always.yaml", "server:\n  markers: always\n");
    Daemon daemon(domain, {"--config", always.path()});
    WireClient client(client_settings(domain));
    ASSERT_TRUE(client.wait_matched());
    client.send(cup_request("drawn", false));
    ASSERT_THAT(client.wait_for(1), SizeIs(1));
    EXPECT_TRUE(daemon.wait_for_error_text("event=drawn id=drawn"));
}

}  // namespace
}  // namespace graspd
