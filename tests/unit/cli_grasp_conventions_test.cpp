#include "grasp_conventions.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace graspd::cli {
namespace {

/// From above onto (0.1, 0.2, 0.3): approach along -z, closing along x, so Gy = Gz x Gx = -y.
Eigen::Isometry3d from_above() {
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();
    X_FG.matrix() << 1, 0, 0, 0.1,  //
        0, -1, 0, 0.2,              //
        0, 0, -1, 0.3,              //
        0, 0, 0, 1;
    return X_FG;
}

/// Fingers of 50 mm whose pads are 140 mm in front of H when closed to 20 mm, 130 mm when open to
/// 80 mm, straight between; the tips 10 mm further.
Gripper linkage_gripper() {
    Gripper gripper;
    gripper.name = "linkage";
    gripper.finger_length_m = 0.05;
    gripper.tip_offset_m = 0.01;
    gripper.pad_travel = {{0.02, 0.14}, {0.08, 0.13}};
    return gripper;
}

Eigen::Isometry3d drawn_pose(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    Eigen::Isometry3d pose(turn.normalized());
    pose.translation() = Eigen::Vector3d(normal(random), normal(random), normal(random));
    return pose;
}

Eigen::Matrix4d matrix(std::initializer_list<double> rows) {
    Eigen::Matrix4d out;
    auto entry = rows.begin();
    for (Eigen::Index i = 0; i < 16; ++i) out(i / 4, i % 4) = *entry++;
    return out;
}

// GPD's columns: approach (0 0 -1), binormal (1 0 0), axis (0 -1 0) = approach x binormal. With the
// base 40 mm behind the TCP, which is above it: z = 0.3 + 0.04.
TEST(GraspConventions, GpdHandFromAbove) {
    const Eigen::Matrix4d by_hand = matrix({0, 1, 0, 0.1,    //
                                            0, 0, -1, 0.2,   //
                                            -1, 0, 0, 0.34,  //
                                            0, 0, 0, 1});
    EXPECT_TRUE(tcp_to_gpd(from_above(), -0.04).matrix().isApprox(by_hand, 1e-15));
    EXPECT_TRUE(gpd_to_tcp(Eigen::Isometry3d(by_hand), -0.04).isApprox(from_above(), 1e-15));
}

// A hand that comes along +y and closes along z has the hand axis y x z = x.
TEST(GraspConventions, GpdHandFromTheSide) {
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();
    X_FG.linear().col(0) = Eigen::Vector3d::UnitZ();  // closing
    X_FG.linear().col(1) = Eigen::Vector3d::UnitX();  // Gy = Gz x Gx = y x z
    X_FG.linear().col(2) = Eigen::Vector3d::UnitY();  // approach
    const Eigen::Isometry3d X_FD = tcp_to_gpd(X_FG, -0.06);
    EXPECT_TRUE(X_FD.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
    EXPECT_TRUE(X_FD.linear().col(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-15));
    EXPECT_TRUE(X_FD.linear().col(2).isApprox(Eigen::Vector3d::UnitX(), 1e-15));
    EXPECT_TRUE(X_FD.translation().isApprox(Eigen::Vector3d(0, -0.06, 0), 1e-15));
}

// Contact at 20 mm puts the pads at 0.14. Open by 50 mm they are at 0.135, the tips at 0.145; 50 mm
// behind these is 0.095, which is 45 mm behind the TCP. A GPD hand_depth of 60 mm adds 10 mm.
TEST(GraspConventions, GpdBaseIsTheHandsDepthBehindTheOpenTips) {
    EXPECT_NEAR(gpd_base_z_G_m(linkage_gripper(), 0.02, 0.05, 0.05), -0.045, 1e-15);
    EXPECT_NEAR(gpd_base_z_G_m(linkage_gripper(), 0.02, 0.05, 0.06), -0.055, 1e-15);
}

// The axes stay ours; the base link is 0.14 behind the TCP, so above it: z = 0.3 + 0.14.
TEST(GraspConventions, GraspGenBaseFromAbove) {
    const Eigen::Matrix4d by_hand = matrix({1, 0, 0, 0.1,    //
                                            0, -1, 0, 0.2,   //
                                            0, 0, -1, 0.44,  //
                                            0, 0, 0, 1});
    EXPECT_TRUE(tcp_to_graspgen(from_above(), 0.14).matrix().isApprox(by_hand, 1e-15));
    EXPECT_TRUE(graspgen_to_tcp(Eigen::Isometry3d(by_hand), 0.14).isApprox(from_above(), 1e-15));
}

// A hand whose fingers close along Hy (closing_yaw 90 degrees) and whose link L lies 20 mm behind
// H, turned by 180 degrees about Hz. Gx = x is Hy, Gz = -z is Hz, so Hx = Hy x Hz = x x (-z) = y;
// H is at z = 0.44. Lx = -Hx = -y, Ly = -Hy = -x, Lz = Hz = -z; L is at z = 0.46.
TEST(GraspConventions, LinkOfAHandThatClosesAlongItsY) {
    Gripper gripper = linkage_gripper();
    gripper.closing_yaw_rad = std::numbers::pi / 2.0;
    Eigen::Isometry3d X_HL = Eigen::Isometry3d::Identity();
    X_HL.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix();
    X_HL.translation().z() = -0.02;
    const Eigen::Matrix4d by_hand = matrix({0, -1, 0, 0.1,   //
                                            -1, 0, 0, 0.2,   //
                                            0, 0, -1, 0.46,  //
                                            0, 0, 0, 1});
    const Eigen::Isometry3d X_HG = grasp_in_hand(gripper, 0.02);
    EXPECT_TRUE(tcp_to_link(from_above(), X_HG, X_HL).matrix().isApprox(by_hand, 1e-12));
    EXPECT_TRUE(link_to_tcp(Eigen::Isometry3d(by_hand), X_HG, X_HL).isApprox(from_above(), 1e-12));
}

TEST(GraspConventions, EachUndoesTheOther) {
    std::mt19937 random(7);
    for (int i = 0; i < 100; ++i) {
        const Eigen::Isometry3d X_FG = drawn_pose(random);
        const Eigen::Isometry3d X_HL = drawn_pose(random), X_HG = drawn_pose(random);
        const double length_m = 0.01 * i;
        const auto same = [&](const Eigen::Isometry3d& pose) {
            return (pose.matrix() - X_FG.matrix()).cwiseAbs().maxCoeff() < 1e-12;
        };
        EXPECT_TRUE(same(gpd_to_tcp(tcp_to_gpd(X_FG, -length_m), -length_m)));
        EXPECT_TRUE(same(graspgen_to_tcp(tcp_to_graspgen(X_FG, length_m), length_m)));
        EXPECT_TRUE(same(link_to_tcp(tcp_to_link(X_FG, X_HG, X_HL), X_HG, X_HL)));
    }
}

}  // namespace
}  // namespace graspd::cli
