#include <algorithm>

#include "graspd/base/moveit_motion.hpp"
#include "write_exports.hpp"
#include "yaml_text.hpp"

namespace graspd::cli {
namespace {

using YAML::Key;
using YAML::Value;

/// What the daemon's requests have when nobody says otherwise; graspctl plans with it.
const double kGripForce_N = PlanOptions{}.grip_force_N;

/// std_msgs/Header. A stamp of zero asks for the newest transform.
void write_header(YAML::Emitter& out, const std::string& frame_id) {
    out << Key << "header" << Value << YAML::BeginMap;
    out << Key << "stamp" << Value << YAML::Flow << YAML::BeginMap << Key << "sec" << Value << 0
        << Key << "nanosec" << Value << 0 << YAML::EndMap;
    out << Key << "frame_id" << Value << YamlText{frame_id} << YAML::EndMap;
}

/// trajectory_msgs/JointTrajectory: one point for the joints of a hand; without joints none.
void write_posture(YAML::Emitter& out, const char* key, const MoveItHand& hand, double opening_m,
                   bool grips) {
    out << Key << key << Value << YAML::BeginMap;
    write_header(out, "");
    out << Key << "joint_names" << Value << YAML::Flow << YAML::BeginSeq;
    for (const MoveItJoint& joint : hand.joints) out << YamlText{joint.name};
    out << YAML::EndSeq << Key << "points" << Value;
    if (hand.joints.empty()) {
        out << YAML::Flow << YAML::BeginSeq << YAML::EndSeq << YAML::EndMap;
        return;
    }
    std::vector<double> positions, effort;
    for (const MoveItJoint& joint : hand.joints) positions.push_back(position_at(joint, opening_m));
    // The force on a finger is a joint's effort only where the joint is the finger.
    if (grips && std::ranges::all_of(hand.joints, &MoveItJoint::slides)) {
        effort.assign(hand.joints.size(), kGripForce_N);
    }
    out << YAML::BeginSeq << YAML::BeginMap;
    out << Key << "positions" << Value << YamlFloats{positions};
    out << Key << "velocities" << Value << YamlFloats{};
    out << Key << "accelerations" << Value << YamlFloats{};
    out << Key << "effort" << Value << YamlFloats{effort};
    out << Key << "time_from_start" << Value << YAML::Flow << YAML::BeginMap << Key << "sec"
        << Value << 0 << Key << "nanosec" << Value << 0 << YAML::EndMap;
    out << YAML::EndMap << YAML::EndSeq << YAML::EndMap;
}

/// moveit_msgs/GripperTranslation.
void write_translation(YAML::Emitter& out, const char* key, const std::string& frame_id,
                       const LinearMotion& motion) {
    out << Key << key << Value << YAML::BeginMap;
    out << Key << "direction" << Value << YAML::BeginMap;
    write_header(out, frame_id);
    out << Key << "vector" << Value << YamlVector{motion.direction_F} << YAML::EndMap;
    out << Key << "desired_distance" << Value << YamlFloat{motion.distance_m};
    out << Key << "min_distance" << Value << YamlFloat{kMoveItLeastShare * motion.distance_m};
    out << YAML::EndMap;
}

void write_pose(YAML::Emitter& out, const std::string& frame_id, const Eigen::Isometry3d& X_FL) {
    const Eigen::Quaterniond turn = quaternion_of(X_FL);
    out << Key << "grasp_pose" << Value << YAML::BeginMap;
    write_header(out, frame_id);
    out << Key << "pose" << Value << YAML::BeginMap;
    out << Key << "position" << Value << YamlVector{X_FL.translation()};
    out << Key << "orientation" << Value << YAML::Flow << YAML::BeginMap;
    out << Key << "x" << Value << YamlFloat{turn.x()} << Key << "y" << Value << YamlFloat{turn.y()};
    out << Key << "z" << Value << YamlFloat{turn.z()} << Key << "w" << Value << YamlFloat{turn.w()};
    out << YAML::EndMap << YAML::EndMap << YAML::EndMap;
}

void write_grasp(YAML::Emitter& out, const GraspFile& file, std::size_t index,
                 const MoveItHand& hand, const std::string& object) {
    const Grasp& grasp = file.grasps[index];
    out << YAML::BeginMap;
    out << Key << "id" << Value << YamlText{"grasp_" + std::to_string(file.ranks[index])};
    write_posture(out, "pre_grasp_posture", hand, grasp.open_width_m, false);
    write_posture(out, "grasp_posture", hand, grasp.width_m, true);
    write_pose(out, file.frame_id, grasp.X_FH * hand.X_HP);
    out << Key << "grasp_quality" << Value << YamlFloat{grasp.score};
    write_translation(out, "pre_grasp_approach", file.frame_id, grasp.approach);
    write_translation(out, "post_grasp_retreat", file.frame_id, grasp.retreat);
    // After the object was put down the hand goes back along its own approach, wherever that is.
    const bool named = !hand.parent_link.empty();
    const Eigen::Vector3d forward = named ? approach_in_link(hand) : grasp.approach.direction_F;
    const LinearMotion back = {-forward, grasp.approach.distance_m};
    write_translation(out, "post_place_retreat", named ? hand.parent_link : file.frame_id, back);
    out << Key << "max_contact_force" << Value << YamlFloat{kGripForce_N};
    out << Key << "allowed_touch_objects" << Value << YAML::Flow << YAML::BeginSeq
        << YamlText{object} << YAML::EndSeq << YAML::EndMap;
}

}  // namespace

Result<std::string> write_moveit_yaml(const GraspFile& file, std::span<const ExportHand> hands,
                                      const ExportOptions& options) {
    std::string text;
    for (std::size_t i = 0; i < file.grasps.size(); ++i) {
        auto found = hand_of(file, i, hands);
        if (!found.ok()) return found.error();
        MoveItHand& hand = found.value().moveit;
        if (options.X_HL) hand.X_HP = *options.X_HL;
        if (!options.link.empty()) hand.parent_link = options.link;
        YAML::Emitter out;
        write_grasp(out, file, i, hand, options.object.empty() ? file.request_id : options.object);
        text += (i > 0 ? "---\n" : "") + std::string(out.c_str()) + "\n";
    }
    return text;
}

}  // namespace graspd::cli
