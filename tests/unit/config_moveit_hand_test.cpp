#include "graspd/config/load_moveit_hand.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "graspd/config/load_gripper.hpp"

namespace graspd {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path kGrippers = GRASPD_SOURCE_DIR "/profiles/grippers";

MoveItHand shipped(const std::string& name) {
    const auto hands = load_moveit_hands(kGrippers);
    EXPECT_TRUE(hands.ok()) << hands.error().detail;
    for (const MoveItHand& hand : hands.value()) {
        if (hand.gripper == name) return hand;
    }
    ADD_FAILURE() << name;
    return {};
}

// Each finger goes half the way.
TEST(MoveItHands, FingersThatSlideStandHalfTheOpeningFromTheMiddle) {
    for (const char* name : {"franka_hand", "parallel_85"}) {
        const MoveItHand hand = shipped(name);
        ASSERT_EQ(hand.joints.size(), 2u);
        for (const MoveItJoint& joint : hand.joints) {
            EXPECT_TRUE(joint.slides);
            EXPECT_DOUBLE_EQ(position_at(joint, 0.05), 0.025);
            EXPECT_DOUBLE_EQ(position_at(joint, 0.0), 0.0);
            EXPECT_DOUBLE_EQ(position_at(joint, -1.0), 0.0);
        }
    }
    EXPECT_EQ(shipped("franka_hand").joints[0].name, "panda_finger_joint1");
    EXPECT_DOUBLE_EQ(position_at(shipped("franka_hand").joints[0], 1.0), 0.04);
}

// franka_description fixes the hand to link 8 with rpy (0, 0, -pi/4): seen from the hand the link
// is turned the other way.
TEST(MoveItHands, FrankasLinkIsTurnedByAnEighth) {
    const MoveItHand hand = shipped("franka_hand");
    EXPECT_EQ(hand.parent_link, "panda_link8");
    const double half = std::numbers::sqrt2 / 2.0;
    EXPECT_TRUE(hand.X_HP.linear().col(0).isApprox(Eigen::Vector3d(half, half, 0.0), 1e-12));
    EXPECT_TRUE(hand.X_HP.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
    EXPECT_TRUE(hand.X_HP.translation().isZero());
}

// Forward kinematics by hand: from the driver's joint two fixed offsets lead to the joint of the
// fingertip, which turns back, so that the pad goes where that joint goes. The pads' own thickness
// follows from the opening at angle 0.
TEST(MoveItHands, TheTwoFingers85FollowTheirLinkage) {
    const MoveItJoint joint = shipped("robotiq_2f_85").joints.at(0);
    EXPECT_FALSE(joint.slides);
    const Eigen::Vector2d arm(0.03152616 + 0.00563134, -0.00376347 + 0.04718515);  // x, z
    const auto x_at = [&](double q) { return std::cos(q) * arm.x() - std::sin(q) * arm.y(); };
    for (double opening_m = 0.0010; opening_m <= 0.0850; opening_m += 0.0007) {
        const double q = position_at(joint, opening_m);
        EXPECT_NEAR(0.0850 + 2.0 * (x_at(q) - x_at(0.0)), opening_m, 1e-4) << q;
    }
    EXPECT_NEAR(position_at(joint, 0.0010), 0.7929, 1e-3);  // measured: closed
    EXPECT_NEAR(position_at(joint, 0.0850), 0.0, 1e-4);
}

TEST(MoveItHands, TheTwoFingers140FollowTheirLinkage) {
    const MoveItJoint joint = shipped("robotiq_2f_140").joints.at(0);
    const Eigen::Vector2d arm(0.01821998610742 + 0.0817554015893473,
                              0.0260018192872234 - 0.0282203446692936);  // y, z
    const auto y_at = [&](double q) {  // the joint stands turned by 90 degrees and 0.725 rad
        const double turn_rad = 0.5 * std::numbers::pi + 0.725 - q;
        return std::cos(turn_rad) * arm.x() - std::sin(turn_rad) * arm.y();
    };
    for (double opening_m = 0.0008; opening_m <= 0.1285; opening_m += 0.0009) {
        const double q = position_at(joint, opening_m);
        EXPECT_NEAR(0.1285 - 2.0 * (y_at(q) - y_at(0.0)), opening_m, 1e-4) << q;
    }
    EXPECT_NEAR(position_at(joint, 0.0008), 0.695, 1e-3);  // measured: closed
}

class MoveItGroup : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(directory_); }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    Result<MoveItHand> load(const std::string& group) {
        const auto file = directory_ / "hand.yaml";
        std::ofstream(file) << "name: hand\nmax_width: 0.1\nfinger_length: 0.05\n"
                               "finger_width: 0.02\nfinger_thickness: 0.01\ntip_offset: 0.012\n"
                               "palm_width: 0.13\npalm_height: 0.06\npalm_depth: 0.09\n"
                            << group;
        const auto gripper = load_gripper(file);
        if (!gripper.ok()) return gripper.error();
        return load_moveit_hand(file, gripper.value());
    }
    std::string error_of(const std::string& group) {
        const auto hand = load(group);
        EXPECT_FALSE(hand.ok()) << group;
        return hand.ok() ? "" : hand.error().detail;
    }

private:
    std::filesystem::path directory_ = std::filesystem::temp_directory_path() /
                                       ("graspd_moveit_hand_" + std::to_string(::getpid()));
};

TEST_F(MoveItGroup, MayBeAbsent) {
    const auto hand = load("");
    ASSERT_TRUE(hand.ok());
    EXPECT_EQ(hand.value().gripper, "hand");
    EXPECT_EQ(hand.value().parent_link, "");
    EXPECT_TRUE(hand.value().joints.empty());
    EXPECT_TRUE(hand.value().X_HP.matrix().isIdentity(0.0));
}

// A roll of 90 degrees, then a yaw of 90 degrees about the fixed z: x goes to y, y by way of z
// stays up.
TEST_F(MoveItGroup, HasItsPoseAsAUrdfSaysIt) {
    const auto hand = load(
        "moveit: {parent_xyz: [1, 2, 3], parent_rpy: [1.5707963267948966, 0, "
        "1.5707963267948966]}\n");
    ASSERT_TRUE(hand.ok()) << hand.error().detail;
    EXPECT_TRUE(hand.value().X_HP.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
    EXPECT_TRUE(hand.value().X_HP.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
    EXPECT_TRUE(hand.value().X_HP.linear().col(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST_F(MoveItGroup, ErrorsNameTheKey) {
    EXPECT_THAT(error_of("moveit: {parents: a}\n"), HasSubstr("parents"));
    EXPECT_THAT(error_of("moveit: 3\n"), HasSubstr("moveit"));
    EXPECT_THAT(error_of("moveit: {parent_xyz: [1, 2]}\n"), HasSubstr("moveit.parent_xyz"));
    EXPECT_THAT(error_of("moveit: {parent_rpy: [1, 2, .nan]}\n"), HasSubstr("moveit.parent_rpy"));
    EXPECT_THAT(error_of("moveit: {joints: [{slides: true}]}\n"), HasSubstr("moveit.joints[0]"));
    EXPECT_THAT(error_of("moveit: {joints: [{name: j}]}\n"),
                AllOf(HasSubstr("moveit.joints[0]"), HasSubstr("no urdf")));
    EXPECT_THAT(error_of("moveit: {joints: [{name: j, positions: [{opening: 0.1, position: 1}, "
                         "{opening: 0.1, position: 2}]}]}\n"),
                HasSubstr("moveit.joints[0].positions"));
}

}  // namespace
}  // namespace graspd
