#include "read_grasps.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli_export_samples.hpp"
#include "plan_arguments.hpp"

namespace graspd::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json sample() {
    return json::parse(sample_json());
}

std::string refusal(const json& reply) {
    const auto file = read_grasps(reply.dump());
    EXPECT_FALSE(file.ok());
    if (file.ok()) return "";
    EXPECT_EQ(file.error().code, PlanErrorCode::kInvalidInput);
    return file.error().detail;
}

bool near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() < 1e-12;
}

TEST(ReadGrasps, GivesBackWhatWasWritten) {
    const auto file = read_grasps(sample_json());
    ASSERT_TRUE(file.ok()) << file.error().detail;
    EXPECT_EQ(file.value().request_id, "mug");
    EXPECT_EQ(file.value().frame_id, "table");
    EXPECT_EQ(file.value().status, "OK");
    EXPECT_EQ(file.value().ranks, (std::vector<std::uint32_t>{1, 2}));
    ASSERT_EQ(file.value().grasps.size(), 2u);
    EXPECT_TRUE(near(file.value().grasps[0].X_FG, grasp_from_above().X_FG));
    EXPECT_TRUE(near(file.value().grasps[0].X_FH, grasp_from_above().X_FH));
    EXPECT_TRUE(near(file.value().grasps[1].X_FG, crooked_grasp().X_FG));
    EXPECT_TRUE(near(file.value().grasps[1].X_FH, crooked_grasp().X_FH));
    const Grasp& grasp = file.value().grasps[0];
    EXPECT_EQ(grasp.width_m, 0.02);
    EXPECT_EQ(grasp.open_width_m, 0.05);
    EXPECT_EQ(grasp.retreat.distance_m, 0.08);
    EXPECT_EQ(grasp.contacts[1].normal_F, Eigen::Vector3d::UnitX());
    EXPECT_EQ(grasp.source, kWall);
    EXPECT_EQ(grasp.terms.size(), 2u);
    ASSERT_TRUE(grasp.tolerance.has_value());
    EXPECT_EQ(grasp.tolerance->turn_rad, 0.1);
    EXPECT_FALSE(file.value().grasps[1].tolerance.has_value());
    ASSERT_TRUE(file.value().gripper.ok());
    EXPECT_EQ(file.value().gripper.value().tip_offset_m, 0.01);
}

// JSON has no infinity; the writer's null comes back as one.
TEST(ReadGrasps, NullIsInfinity) {
    const auto file = read_grasps(sample_json());
    ASSERT_TRUE(file.ok());
    EXPECT_TRUE(std::isinf(file.value().grasps[0].clearance_m));
}

TEST(ReadGrasps, WhatIsNoReplyOfOursIsRefused) {
    EXPECT_THAT(read_grasps("no json").error().detail, HasSubstr("cannot be read as JSON"));
    EXPECT_THAT(read_grasps("[1, 2]").error().detail, HasSubstr("the whole file = [1,2]"));
    EXPECT_THAT(refusal({{"grasps", json::array()}}), HasSubstr("schema is missing"));
    json other = sample();
    other["schema"] = "moveit/1";
    EXPECT_THAT(refusal(other), HasSubstr("schema = \"moveit/1\" must be graspd/1"));
    other = sample();
    other["convention"] = "camera";
    EXPECT_THAT(refusal(other), HasSubstr("convention = \"camera\" must be tcp_z"));
}

TEST(ReadGrasps, AMissingMemberIsNamed) {
    for (const char* key :
         {"rank", "position", "quaternion", "width", "open_width", "score", "approach", "retreat",
          "contacts", "clearance", "gripper", "source", "terms", "concavity"}) {
        json reply = sample();
        reply["grasps"][1].erase(key);
        EXPECT_EQ(refusal(reply), "grasps[1]." + std::string(key) + " is missing");
    }
    json reply = sample();
    reply["grasps"][0]["approach"].erase("distance");
    EXPECT_EQ(refusal(reply), "grasps[0].approach.distance is missing");
    reply = sample();
    reply["grasps"][0].erase("hand_pose");
    EXPECT_THAT(refusal(reply), HasSubstr("grasps[0].hand_pose is missing; it follows from the"));
}

TEST(ReadGrasps, AWrongValueIsNamedWithIt) {
    json reply = sample();
    reply["grasps"][0]["quaternion"] = {0, 0, 0, 2};
    EXPECT_EQ(refusal(reply), "grasps[0].quaternion = [0,0,0,2] is not of unit length");
    reply = sample();
    reply["grasps"][0]["position"] = {0, 0};
    EXPECT_EQ(refusal(reply), "grasps[0].position = [0,0] must be 3 numbers");
    reply = sample();
    reply["grasps"][0]["width"] = "wide";
    EXPECT_EQ(refusal(reply), "grasps[0].width = \"wide\" must be a number");
    reply = sample();
    reply["grasps"][0]["source"] = "luck";
    EXPECT_THAT(refusal(reply), HasSubstr("grasps[0].source = \"luck\" must be boundary"));
    reply = sample();
    reply["grasps"][0]["rotation"] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    EXPECT_THAT(refusal(reply), HasSubstr("is another rotation than quaternion"));
    reply = sample();
    reply["grasps"][0]["hand_pose"]["position"] = {0.2, 0.2, 0.44};
    EXPECT_THAT(refusal(reply), HasSubstr("grasps[0].hand_pose = "));
    EXPECT_THAT(refusal(reply), HasSubstr("does not lie behind the grasp's pose"));
}

// Without the member the mounting frame follows from the gripper: 0.14 behind the TCP.
TEST(ReadGrasps, AGripperStandsInForAMissingHandPose) {
    json reply = sample();
    reply["grasps"][0].erase("hand_pose");
    const Gripper gripper = sample_gripper();
    const auto file = read_grasps(reply.dump(), &gripper);
    ASSERT_TRUE(file.ok()) << file.error().detail;
    EXPECT_TRUE(near(file.value().grasps[0].X_FH, grasp_from_above().X_FH));
}

TEST(ReadGrasps, AnIncompleteGripperSaysWhatItLacks) {
    json reply = sample();
    reply["gripper"].erase("palm_z");
    const auto file = read_grasps(reply.dump());
    ASSERT_TRUE(file.ok());
    ASSERT_FALSE(file.value().gripper.ok());
    EXPECT_EQ(file.value().gripper.error().detail, "gripper.palm_z is missing");
}

// The profile says: the hand is turned by 45 degrees on panda_link8, at the same place.
TEST(FindHand, TakesAProfileByNameAndByFile) {
    const std::filesystem::path grippers = GRASPD_SOURCE_DIR "/profiles/grippers";
    for (const std::string& name :
         {std::string("franka_hand"), (grippers / "franka_hand.yaml").string()}) {
        const auto hand = find_hand(name, grippers);
        ASSERT_TRUE(hand.ok()) << hand.error().detail;
        EXPECT_EQ(hand.value().gripper.max_width_m, 0.08);
        EXPECT_EQ(hand.value().moveit.parent_link, "panda_link8");
        EXPECT_NEAR(hand.value().moveit.X_HP.linear()(0, 0), std::sqrt(0.5), 1e-12);
        EXPECT_EQ(hand.value().moveit.joints.size(), 2u);
    }
}

TEST(FindHand, AnUnknownGripperIsNamedWithItsGrasp) {
    const std::filesystem::path grippers = GRASPD_SOURCE_DIR "/profiles/grippers";
    GraspFile file;
    file.grasps.resize(2);
    file.grasps[0].gripper_name = "parallel_85";
    for (const char* name : {"my_hand", "../franka_hand.yaml"}) {
        file.grasps[1].gripper_name = name;
        const auto hands = find_hands(file, grippers);
        ASSERT_FALSE(hands.ok());
        EXPECT_EQ(hands.error().code, PlanErrorCode::kUnknownGripper);
        EXPECT_THAT(hands.error().detail, HasSubstr("grasps[1]: gripper = " + std::string(name)));
    }
    file.grasps[1].gripper_name = "parallel_85";
    EXPECT_EQ(find_hands(file, grippers).value().size(), 1u);
}

TEST(ParsePose, ReadsMetresAndAUnitQuaternion) {
    const auto pose = parse_pose("--eef-transform", "0.1,0,-0.2,0,0,1,0");
    ASSERT_TRUE(pose.ok());
    EXPECT_EQ(pose.value().translation(), Eigen::Vector3d(0.1, 0, -0.2));
    EXPECT_EQ(pose.value().linear().diagonal(), Eigen::Vector3d(-1, -1, 1));
    for (const char* text : {"", "0,0,0", "0,0,0,0,0,0,x", "nan,0,0,0,0,0,1"}) {
        const auto bad = parse_pose("--eef-transform", text);
        ASSERT_FALSE(bad.ok());
        EXPECT_THAT(bad.error().detail,
                    HasSubstr("--eef-transform = " + std::string(text) + " must be X,Y,Z"));
    }
    EXPECT_THAT(parse_pose("--eef-transform", "0,0,0,0,0,0,2").error().detail,
                HasSubstr("must be a pose with a quaternion of unit length"));
}

}  // namespace
}  // namespace graspd::cli
