#include "plan_markers.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <map>
#include <numbers>

#include "graspd/base/solid_meshes.hpp"

namespace graspd::dds {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using visualization_msgs::msg::dds_::Marker_;
using visualization_msgs::msg::dds_::MarkerArray_;

std_msgs::msg::dds_::Header_ header() {
    std_msgs::msg::dds_::Header_ out;
    out.frame_id("table");
    out.stamp().sec(17);
    out.stamp().nanosec(23);
    return out;
}

/// Of two boxes, an upright and a bar: 24 faces, 16 vertices. Depths rise from 0 in thirds of
/// 40 mm: those of the first three vertices are 0, 10 and 20 mm, the fourth lies at 40 mm.
PlanPicture two_boxes() {
    PlanPicture picture;
    picture.object_F = box_mesh({0.02, 0.02, 0.1});
    const TriangleMesh bar = box_mesh({0.1, 0.02, 0.02});
    const auto first = static_cast<std::uint32_t>(picture.object_F.vertices.size());
    picture.object_F.vertices.insert(picture.object_F.vertices.end(), bar.vertices.begin(),
                                     bar.vertices.end());
    for (const Triangle& face : bar.faces) {
        picture.object_F.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    }
    picture.concavity_m.assign(picture.object_F.vertices.size(), 0.0);
    picture.concavity_m[1] = 0.01;
    picture.concavity_m[2] = 0.02;
    picture.concavity_m[3] = 0.04;
    picture.concavity_m[4] = std::numeric_limits<double>::infinity();
    picture.deepest_m = 0.04;
    picture.spacing_m = 0.003;
    return picture;
}

/// A grasp with what a picture shows of it.
Grasp grasp_of(double score, double x_m) {
    Grasp grasp;
    grasp.score = score;
    grasp.X_FH.translation() = Eigen::Vector3d(x_m, 0.1, 0.2);
    grasp.contacts[0].point_F = Eigen::Vector3d(x_m, 1.0, 0.0);
    grasp.contacts[1].point_F = Eigen::Vector3d(x_m, 2.0, 0.0);
    return grasp;
}

/// Two grasps, the first by a hand of a box and a hull, the second by one of a box.
struct Sample {
    PlanPicture picture = two_boxes();
    PlanReply reply;

    Sample() {
        reply.status = PlanStatus::kOk;
        reply.grasps = {grasp_of(0.9, 0.5), grasp_of(0.25, 0.6)};
        OrientedBox box;
        box.pose.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitX()));
        box.pose.pretranslate(Eigen::Vector3d(0.1, 0.2, 0.3));
        box.half_extent = Eigen::Vector3d(0.01, 0.02, 0.03);
        picture.hands_F = {{box, box_mesh({0.01, 0.01, 0.01})}, {box}};
        picture.regions = {{{{1, 2, 3}, {4, 5, 6}}, 0.04}, {{{7, 8, 9}}, 0.02}};
    }
    MarkerArray_ markers() const { return plan_markers(picture, reply, header()); }
};

std::map<std::string, std::vector<Marker_>> by_namespace(const MarkerArray_& array) {
    std::map<std::string, std::vector<Marker_>> sorted;
    for (const Marker_& marker : array.markers()) sorted[marker.ns()].push_back(marker);
    return sorted;
}

std::vector<float> rgba(const std_msgs::msg::dds_::ColorRGBA_& color) {
    return {color.r(), color.g(), color.b(), color.a()};
}

std::vector<double> xyz(const geometry_msgs::msg::dds_::Point_& point) {
    return {point.x(), point.y(), point.z()};
}

std::vector<double> xyz(const geometry_msgs::msg::dds_::Vector3_& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

TEST(PlanMarkers, DeleteWhatWasThereThenShowEachKindInItsNamespace) {
    const MarkerArray_ array = Sample().markers();
    ASSERT_FALSE(array.markers().empty());
    EXPECT_EQ(array.markers()[0].action(), 3);  // DELETEALL
    EXPECT_EQ(array.markers()[0].ns(), "");     // of every namespace
    auto kinds = by_namespace(array);
    EXPECT_THAT(kinds, SizeIs(6));
    EXPECT_THAT(kinds["object"], SizeIs(1));
    EXPECT_THAT(kinds["regions"], SizeIs(2));
    EXPECT_THAT(kinds["grippers"], SizeIs(3));
    EXPECT_THAT(kinds["contacts"], SizeIs(1));
    EXPECT_THAT(kinds["labels"], SizeIs(2));
    for (const auto& [name, markers] : kinds) {
        for (std::size_t i = 0; i < markers.size(); ++i) {
            EXPECT_EQ(markers[i].id(), static_cast<int>(i)) << name;
            EXPECT_EQ(markers[i].header().frame_id(), "table");
            EXPECT_EQ(markers[i].header().stamp().sec(), 17);
            EXPECT_EQ(markers[i].header().stamp().nanosec(), 23u);
            EXPECT_NE(markers[i].pose().orientation().w(), 0.0) << name;
            EXPECT_EQ(markers[i].lifetime().sec(), 0);
            EXPECT_EQ(markers[i].action(), name.empty() ? 3 : 0);
        }
    }
}

// 24 triangles of three corners. A quarter of the scale is cyan, a half green, all of it red.
TEST(PlanMarkers, TheObjectIsColouredCornerByCorner) {
    const Sample sample;
    const Marker_ object = by_namespace(sample.markers())["object"].at(0);
    EXPECT_EQ(object.type(), 11);  // TRIANGLE_LIST
    EXPECT_THAT(xyz(object.scale()), ElementsAre(1.0, 1.0, 1.0));
    EXPECT_THAT(rgba(object.color()), ElementsAre(1, 1, 1, 1));  // RViz multiplies by its alpha
    ASSERT_THAT(object.points(), SizeIs(72));
    ASSERT_THAT(object.colors(), SizeIs(72));
    const std::vector<std::vector<float>> expected = {
        {0, 0, 1, 1}, {0, 1, 1, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}, {0.3F, 0.3F, 0.3F, 1}};
    std::vector<int> seen(5, 0);
    for (std::size_t i = 0; i < 72; ++i) {
        const std::uint32_t vertex = sample.picture.object_F.faces[i / 3][i % 3];
        const Eigen::Vector3d& at = sample.picture.object_F.vertices[vertex];
        EXPECT_THAT(xyz(object.points()[i]), ElementsAre(at.x(), at.y(), at.z()));
        const std::size_t row = vertex < 5 ? vertex : 0;
        EXPECT_EQ(rgba(object.colors()[i]), expected[row]) << vertex;
        ++seen[row];
    }
    EXPECT_THAT(seen, testing::Each(testing::Gt(2)));
}

TEST(PlanMarkers, ColoursBetweenThoseOfTheScaleAreMixed) {
    Sample sample;
    sample.picture.concavity_m.assign(16, 0.035);  // 7/8: midway between yellow and red
    const Marker_ object = by_namespace(sample.markers())["object"].at(0);
    EXPECT_THAT(rgba(object.colors()[0]),
                ElementsAre(1.0F, testing::FloatNear(0.5F, 1e-6F), 0.0F, 1.0F));
}

TEST(PlanMarkers, RegionsAreSpheresAtTheirSamples) {
    const auto regions = by_namespace(Sample().markers())["regions"];
    ASSERT_THAT(regions, SizeIs(2));
    EXPECT_EQ(regions[0].type(), 7);  // SPHERE_LIST
    ASSERT_THAT(regions[0].points(), SizeIs(2));
    EXPECT_THAT(xyz(regions[0].points()[1]), ElementsAre(4, 5, 6));
    EXPECT_THAT(regions[1].points(), SizeIs(1));
    EXPECT_NEAR(regions[0].scale().x(), 0.0018, 1e-12);  // 0.6 of 3 mm
    EXPECT_NE(rgba(regions[0].color()), rgba(regions[1].color()));
}

// A quarter turn about x is the quaternion (sqrt(1/2), 0, 0, sqrt(1/2)).
TEST(PlanMarkers, HandsHaveTheirPartsAtTheirPoses) {
    const auto parts = by_namespace(Sample().markers())["grippers"];
    ASSERT_THAT(parts, SizeIs(3));
    EXPECT_EQ(parts[0].type(), 1);  // CUBE
    EXPECT_THAT(xyz(parts[0].pose().position()), ElementsAre(0.1, 0.2, 0.3));
    EXPECT_NEAR(parts[0].pose().orientation().x(), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(parts[0].pose().orientation().w(), std::sqrt(0.5), 1e-12);
    EXPECT_THAT(xyz(parts[0].scale()), ElementsAre(0.02, 0.04, 0.06));
    EXPECT_EQ(parts[1].type(), 11);
    EXPECT_THAT(parts[1].points(), SizeIs(36));
    EXPECT_THAT(parts[1].colors(), IsEmpty());
    EXPECT_EQ(parts[2].type(), 1);
}

// 0.9 is green with a fifth of red; 0.25 is red with half of green.
TEST(PlanMarkers, TheBestHandIsOpaqueAndScoresHaveColours) {
    const auto kinds = by_namespace(Sample().markers());
    const auto& parts = kinds.at("grippers");
    const auto near = [](float value) { return testing::FloatNear(value, 1e-6F); };
    EXPECT_THAT(rgba(parts.at(1).color()), ElementsAre(near(0.2F), near(1), near(0), near(1)));
    EXPECT_THAT(rgba(parts.at(2).color()), ElementsAre(near(1), near(0.5F), near(0), near(0.3F)));
    const Marker_& contacts = kinds.at("contacts").at(0);
    EXPECT_EQ(contacts.type(), 7);
    ASSERT_THAT(contacts.points(), SizeIs(4));
    ASSERT_THAT(contacts.colors(), SizeIs(4));
    EXPECT_THAT(xyz(contacts.points()[1]), ElementsAre(0.5, 2.0, 0.0));
    EXPECT_THAT(xyz(contacts.points()[2]), ElementsAre(0.6, 1.0, 0.0));
    EXPECT_THAT(rgba(contacts.colors()[3]), ElementsAre(near(1), near(0.5F), near(0), near(1)));
}

TEST(PlanMarkers, LabelsNameRankAndScore) {
    const auto labels = by_namespace(Sample().markers())["labels"];
    ASSERT_THAT(labels, SizeIs(2));
    EXPECT_EQ(labels[0].type(), 9);  // TEXT_VIEW_FACING
    EXPECT_EQ(labels[0].text(), "1: 0.90");
    EXPECT_EQ(labels[1].text(), "2: 0.25");
    EXPECT_THAT(xyz(labels[1].pose().position()), ElementsAre(0.6, 0.1, 0.2));
    EXPECT_GT(labels[0].scale().z(), 0.0);
}

// The upright ends at z = 50 mm.
TEST(PlanMarkers, WithoutGraspsTheStatusStandsAboveTheObject) {
    Sample sample;
    sample.picture.hands_F.clear();
    sample.picture.regions.clear();
    sample.reply.grasps.clear();
    sample.reply.status = PlanStatus::kNoGrasp;
    auto kinds = by_namespace(sample.markers());
    EXPECT_THAT(kinds, SizeIs(3));  // deleting, object, label
    ASSERT_THAT(kinds["labels"], SizeIs(1));
    EXPECT_EQ(kinds["labels"][0].text(), "NO_GRASP");
    EXPECT_NEAR(kinds["labels"][0].pose().position().z(), 0.08, 1e-12);
}

}  // namespace
}  // namespace graspd::dds
