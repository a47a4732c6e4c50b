#include "grasp_conventions.hpp"
#include "write_exports.hpp"
#include "yaml_text.hpp"

namespace graspd::cli {
namespace {

using YAML::Key;
using YAML::Value;

/// std_msgs/Float32.
void write_float(YAML::Emitter& out, const char* key, double value) {
    out << Key << key << Value << YAML::Flow << YAML::BeginMap << Key << "data" << Value
        << YamlFloat{value} << YAML::EndMap;
}

/// gpd_ros/GraspConfig.
void write_grasp(YAML::Emitter& out, const Grasp& grasp, const Eigen::Isometry3d& X_FD) {
    out << YAML::BeginMap;
    out << Key << "position" << Value << YamlVector{X_FD.translation()};
    out << Key << "approach" << Value << YamlVector{X_FD.linear().col(0)};
    out << Key << "binormal" << Value << YamlVector{X_FD.linear().col(1)};
    out << Key << "axis" << Value << YamlVector{X_FD.linear().col(2)};
    write_float(out, "width", grasp.width_m);
    write_float(out, "score", grasp.score);
    out << Key << "sample" << Value << YamlVector{grasp.X_FG.translation()} << YAML::EndMap;
}

}  // namespace

Result<std::string> write_gpd_yaml(const GraspFile& file, std::span<const ExportHand> hands,
                                   const ExportOptions& options) {
    YAML::Emitter out;
    out << YAML::BeginMap << Key << "header" << Value << YAML::BeginMap;
    out << Key << "seq" << Value << 0 << Key << "stamp" << Value << YAML::Flow << YAML::BeginMap
        << Key << "secs" << Value << 0 << Key << "nsecs" << Value << 0 << YAML::EndMap;
    out << Key << "frame_id" << Value << YamlText{file.frame_id} << YAML::EndMap;
    out << Key << "grasps" << Value << YAML::BeginSeq;
    for (std::size_t i = 0; i < file.grasps.size(); ++i) {
        const auto hand = hand_of(file, i, hands);
        if (!hand.ok()) return hand.error();
        const Grasp& grasp = file.grasps[i];
        const Gripper& gripper = hand.value().gripper;
        const double base_z_G_m =
            gpd_base_z_G_m(gripper, grasp.width_m, grasp.open_width_m,
                           options.hand_depth_m.value_or(gripper.finger_length_m));
        write_grasp(out, grasp, tcp_to_gpd(grasp.X_FG, base_z_G_m));
    }
    out << YAML::EndSeq << YAML::EndMap;
    return std::string(out.c_str()) + "\n";
}

}  // namespace graspd::cli
