#include "write_exports.hpp"
#include "yaml_text.hpp"

namespace graspd::cli {
namespace {

using YAML::Key;
using YAML::Value;

void write_joints(YAML::Emitter& out, const char* key, const MoveItHand& hand, double opening_m) {
    out << Key << key << Value << (hand.joints.empty() ? YAML::Flow : YAML::Block)
        << YAML::BeginMap;
    for (const MoveItJoint& joint : hand.joints) {
        out << Key << YamlText{joint.name} << Value << YamlFloat{position_at(joint, opening_m)};
    }
    out << YAML::EndMap;
}

void write_grasp(YAML::Emitter& out, const Grasp& grasp, const MoveItHand& hand,
                 const Eigen::Isometry3d& X_HL) {
    const Eigen::Isometry3d X_FL = grasp.X_FH * X_HL;
    const Eigen::Quaterniond turn = quaternion_of(X_FL);
    const Eigen::Vector3d position = X_FL.translation(), imaginary = turn.vec();
    out << YAML::BeginMap << Key << "confidence" << Value << YamlFloat{grasp.score};
    out << Key << "position" << Value << YamlFloats{{position.data(), 3}};
    out << Key << "orientation" << Value << YAML::Flow << YAML::BeginMap;
    out << Key << "w" << Value << YamlFloat{turn.w()};
    out << Key << "xyz" << Value << YamlFloats{{imaginary.data(), 3}} << YAML::EndMap;
    write_joints(out, "cspace_position", hand, grasp.width_m);
    write_joints(out, "pregrasp_cspace_position", hand, grasp.open_width_m);
    out << YAML::EndMap;
}

}  // namespace

Result<std::string> write_isaac_grasp(const GraspFile& file, std::span<const ExportHand> hands,
                                      const ExportOptions& options) {
    if (auto error = check_one_gripper(file, "isaac_grasp")) return *std::move(error);
    const auto hand = hand_of(file, 0, hands);
    if (!hand.ok()) return hand.error();
    const std::string& gripper = hand.value().gripper.name;
    YAML::Emitter out;
    out << YAML::BeginMap << Key << "format" << Value << "isaac_grasp";
    out << Key << "format_version" << Value << YamlFloat{1.0};
    out << Key << "object_frame_link" << Value
        << YamlText{options.object.empty() ? file.frame_id : options.object};
    out << Key << "gripper_frame_link" << Value
        << YamlText{options.link.empty() ? gripper : options.link};
    out << Key << "object_scale" << Value << YamlFloat{options.object_scale};
    out << Key << "grasps" << Value << YAML::BeginMap;
    for (std::size_t i = 0; i < file.grasps.size(); ++i) {
        out << Key << "grasp_" + std::to_string(i) << Value;
        write_grasp(out, file.grasps[i], hand.value().moveit,
                    options.X_HL.value_or(Eigen::Isometry3d::Identity()));
    }
    out << YAML::EndMap << YAML::EndMap;
    return std::string(out.c_str()) + "\n";
}

}  // namespace graspd::cli
