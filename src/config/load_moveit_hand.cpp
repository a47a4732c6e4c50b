#include "graspd/config/load_moveit_hand.hpp"

#include <algorithm>
#include <cmath>

#include "graspd/config/load_gripper.hpp"
#include "yaml_scalar.hpp"

namespace graspd {
namespace {

using config_detail::bad_value;
using config_detail::SettingRef;
using std::filesystem::path;

constexpr std::size_t kDriverRows = 65;  // openings at which a linkage's driver is asked

std::optional<PlanError> read_triple(const path& file, const YAML::Node& node, const char* key,
                                     Eigen::Vector3d& to) {
    if (!node.IsDefined()) return std::nullopt;
    bool good = node.IsSequence() && node.size() == 3;
    for (std::size_t i = 0; good && i < 3; ++i) {
        double& number = to[static_cast<Eigen::Index>(i)];
        good = config_detail::parse_scalar(node[i], number) && std::isfinite(number);
    }
    if (good) return std::nullopt;
    return bad_value(file, node, std::string("moveit.") + key, "must be three numbers");
}

/// The driver of a mechanism, at evenly spaced openings.
std::vector<JointAtOpening> driver_positions(const Gripper& gripper) {
    std::vector<JointAtOpening> rows;
    for (std::size_t i = 0; i < kDriverRows; ++i) {
        const double share = static_cast<double>(i) / (kDriverRows - 1);
        const double opening_m =
            gripper.min_width_m + share * (gripper.max_width_m - gripper.min_width_m);
        rows.push_back({opening_m, driver_position(*gripper.linkage, opening_m)});
    }
    return rows;
}

std::optional<PlanError> read_positions(const path& file, const YAML::Node& node,
                                        const std::string& key, std::vector<JointAtOpening>& rows) {
    constexpr const char* kMust = "must be a list of {opening: [m], position}, openings rising";
    if (!node.IsSequence() || node.size() == 0) return bad_value(file, node, key, kMust);
    for (const YAML::Node& entry : node) {
        JointAtOpening row;
        if (!entry.IsMap() || !entry["opening"].IsDefined() || !entry["position"].IsDefined()) {
            return bad_value(file, entry, key, kMust);
        }
        const std::vector<SettingRef> settings = {{{"opening"}, &row.opening_m, ""},
                                                  {{"position"}, &row.position, ""}};
        if (auto error = config_detail::assign_yaml(file, entry, settings, {})) return error;
        const bool finite = std::isfinite(row.opening_m) && std::isfinite(row.position);
        if (!finite || (!rows.empty() && !(row.opening_m > rows.back().opening_m))) {
            return bad_value(file, entry["opening"], key, kMust);
        }
        rows.push_back(row);
    }
    return std::nullopt;
}

std::optional<PlanError> read_joint(const path& file, const YAML::Node& node,
                                    const std::string& key, const Gripper& gripper,
                                    MoveItJoint& joint) {
    if (!node.IsMap()) return bad_value(file, node, key, "must be {name, slides, positions}");
    const std::vector<SettingRef> settings = {{{"name"}, &joint.name, ""},
                                              {{"slides"}, &joint.slides, ""}};
    if (auto error = config_detail::assign_yaml(file, node, settings, {"positions"})) return error;
    if (joint.name.empty()) return bad_value(file, node, key, "must have the joint's name");
    if (node["positions"].IsDefined()) {
        return read_positions(file, node["positions"], key + ".positions", joint.positions);
    }
    if (!gripper.linkage) {
        return bad_value(file, node, key, "must have positions, as the profile has no urdf");
    }
    joint.positions = driver_positions(gripper);
    return std::nullopt;
}

std::optional<PlanError> read_group(const path& file, const YAML::Node& node,
                                    const Gripper& gripper, MoveItHand& hand) {
    if (!node.IsMap()) return bad_value(file, node, "moveit", "must be a group of keys");
    const std::vector<SettingRef> settings = {{{"parent_link"}, &hand.parent_link, ""}};
    if (auto error = config_detail::assign_yaml(file, node, settings,
                                                {"parent_xyz", "parent_rpy", "joints"})) {
        return error;
    }
    Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero(), rpy_rad = Eigen::Vector3d::Zero();
    if (auto error = read_triple(file, node["parent_xyz"], "parent_xyz", xyz_m)) return error;
    if (auto error = read_triple(file, node["parent_rpy"], "parent_rpy", rpy_rad)) return error;
    hand.X_HP = Eigen::Translation3d(xyz_m) *
                Eigen::AngleAxisd(rpy_rad.z(), Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(rpy_rad.y(), Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(rpy_rad.x(), Eigen::Vector3d::UnitX());
    const YAML::Node joints = node["joints"];
    if (!joints.IsDefined()) return std::nullopt;
    if (!joints.IsSequence()) return bad_value(file, joints, "moveit.joints", "must be a list");
    for (const YAML::Node& entry : joints) {
        const std::string key = "moveit.joints[" + std::to_string(hand.joints.size()) + "]";
        if (auto error = read_joint(file, entry, key, gripper, hand.joints.emplace_back())) {
            return error;
        }
    }
    return std::nullopt;
}

}  // namespace

Result<MoveItHand> load_moveit_hand(const path& file, const Gripper& gripper) {
    const auto root = config_detail::load_yaml(file);
    if (!root.ok()) return root.error();
    MoveItHand hand;
    hand.gripper = gripper.name;
    const YAML::Node node = root.value().IsMap() ? root.value()["moveit"] : YAML::Node();
    if (root.value().IsMap() && node.IsDefined()) {
        if (auto error = read_group(file, node, gripper, hand)) return *std::move(error);
    }
    return hand;
}

Result<std::vector<MoveItHand>> load_moveit_hands(const path& directory) {
    std::error_code failed;
    std::vector<path> files;
    for (const auto& entry : std::filesystem::directory_iterator(directory, failed)) {
        if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    std::vector<MoveItHand> hands;
    for (const path& file : files) {
        const auto gripper = load_gripper(file);
        if (!gripper.ok()) return gripper.error();
        auto hand = load_moveit_hand(file, gripper.value());
        if (!hand.ok()) return hand.error();
        hands.push_back(std::move(hand).value());
    }
    std::ranges::sort(hands, {}, &MoveItHand::gripper);
    return hands;
}

}  // namespace graspd
