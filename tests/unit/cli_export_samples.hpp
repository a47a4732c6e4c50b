#pragma once

#include <numbers>

#include "write_exports.hpp"
#include "write_json.hpp"

namespace graspd::cli {

// One hand and one grasp whose poses in every convention are easy to work out by hand.

/// Fingers of 50 mm that slide along Hy; the pads' centres 140 mm in front of H, the tips 10 mm
/// further: palm_z + palm_depth + finger_length - tip_offset = 0 + 0.1 + 0.05 - 0.01.
inline Gripper sample_gripper() {
    Gripper gripper;
    gripper.name = "hand";
    gripper.max_width_m = 0.08;
    gripper.finger_length_m = 0.05;
    gripper.tip_offset_m = 0.01;
    gripper.palm_depth_m = 0.1;
    gripper.closing_yaw_rad = std::numbers::pi / 2.0;
    return gripper;
}

/// The parent link "wrist" lies 20 mm behind H, turned by 180 degrees about Hz; two joints that
/// slide by half the opening.
inline ExportHand sample_hand() {
    ExportHand hand;
    hand.gripper = sample_gripper();
    hand.moveit.gripper = "hand";
    hand.moveit.parent_link = "wrist";
    hand.moveit.X_HP.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix();
    hand.moveit.X_HP.translation().z() = -0.02;
    for (const char* name : {"left_finger", "right_finger"}) {
        hand.moveit.joints.push_back({name, true, {{0.0, 0.0}, {0.08, 0.04}}});
    }
    return hand;
}

/// From above onto (0.1, 0.2, 0.3): Gz = -z, Gx = x, Gy = -y. H is at z = 0.44; Hy = Gx = x,
/// Hz = Gz = -z, Hx = Hy x Hz = y.
inline Grasp grasp_from_above() {
    Grasp grasp;
    grasp.X_FG.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix();
    grasp.X_FG.translation() = Eigen::Vector3d(0.1, 0.2, 0.3);
    grasp.X_FH.linear() << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    grasp.X_FH.translation() = Eigen::Vector3d(0.1, 0.2, 0.44);
    grasp.width_m = 0.02;
    grasp.open_width_m = 0.05;
    grasp.approach = {-Eigen::Vector3d::UnitZ(), 0.1};
    grasp.retreat = {Eigen::Vector3d::UnitZ(), 0.08};
    grasp.contacts = {Contact{{0.09, 0.2, 0.3}, {-1, 0, 0}}, Contact{{0.11, 0.2, 0.3}, {1, 0, 0}}};
    grasp.gripper_name = "hand";
    grasp.score = 0.75;
    grasp.terms = {{"bias", 0.5}, {"torque", -1e-5}};
    grasp.source = kWall;
    grasp.clearance_m = std::numeric_limits<double>::infinity();
    grasp.tolerance = PoseTolerance{0.002, 0.1};
    return grasp;
}

/// A pose with no round numbers in it, for the same hand.
inline Grasp crooked_grasp() {
    Grasp grasp = grasp_from_above();
    const Eigen::Quaterniond turn(0.1, -0.7, 0.3, 0.4);
    grasp.X_FG = Eigen::Isometry3d(turn.normalized());
    grasp.X_FG.translation() = Eigen::Vector3d(0.1 + 0.2, -1.0 / 3.0, 1e-7);
    grasp.X_FH = grasp.X_FG * grasp_in_hand(sample_gripper(), grasp.width_m).inverse();
    grasp.approach.direction_F = grasp.X_FG.linear().col(2);
    grasp.tolerance.reset();
    return grasp;
}

/// The JSON that graspctl writes for both grasps.
inline std::string sample_json() {
    PlanReply reply;
    reply.request_id = "mug";
    reply.frame_id = "table";
    reply.status = PlanStatus::kOk;
    reply.grasps = {grasp_from_above(), crooked_grasp()};
    const std::vector<Gripper> grippers = {sample_gripper()};
    return write_json(reply, grippers, {"0.1.0", "", 1.0});
}

}  // namespace graspd::cli
