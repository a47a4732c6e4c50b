#include "graspd/config/load_gripper.hpp"

#include <algorithm>
#include <array>

#include "graspd/base/hull_points.hpp"
#include "graspd/config/load_config.hpp"
#include "urdf_gripper.hpp"
#include "yaml_scalar.hpp"

namespace graspd {
namespace {

using config_detail::SettingRef;

constexpr std::array kRequired = {"name",         "max_width",        "finger_length",
                                  "finger_width", "finger_thickness", "tip_offset",
                                  "palm_width",   "palm_height",      "palm_depth"};

/// Keys of a profile and where they go; the ranges are validate()'s.
std::vector<SettingRef> gripper_settings(Gripper& gripper) {
    return {{{"name"}, &gripper.name, ""},
            {{"min_width"}, &gripper.min_width_m, ""},
            {{"max_width"}, &gripper.max_width_m, ""},
            {{"finger_length"}, &gripper.finger_length_m, ""},
            {{"finger_width"}, &gripper.finger_width_m, ""},
            {{"finger_thickness"}, &gripper.finger_thickness_m, ""},
            {{"tip_offset"}, &gripper.tip_offset_m, ""},
            {{"palm_width"}, &gripper.palm_width_m, ""},
            {{"palm_height"}, &gripper.palm_height_m, ""},
            {{"palm_depth"}, &gripper.palm_depth_m, ""},
            {{"palm_z"}, &gripper.palm_z_m, ""},
            {{"closing_yaw"}, &gripper.closing_yaw_rad, ""},
            {{"pad_width"}, &gripper.pad_width_m, ""},
            {{"pad_height"}, &gripper.pad_height_m, ""}};
}

std::optional<PlanError> read_travel(const std::filesystem::path& file, const YAML::Node& node,
                                     std::vector<PadTravel>& table) {
    if (!node.IsDefined()) return std::nullopt;
    if (!node.IsSequence()) {
        return config_detail::bad_value(file, node, "pad_travel",
                                        "must be a list of {opening, pad_z}");
    }
    for (const auto& entry : node) {
        PadTravel row;
        const std::vector<SettingRef> settings = {{{"opening"}, &row.opening_m, ""},
                                                  {{"pad_z"}, &row.pad_z_m, ""}};
        const YAML::Node opening = entry.IsMap() ? entry["opening"] : YAML::Node();
        const YAML::Node pad_z = entry.IsMap() ? entry["pad_z"] : YAML::Node();
        if (!entry.IsMap() || !opening.IsDefined() || !pad_z.IsDefined()) {
            return config_detail::bad_value(file, entry, "pad_travel row",
                                            "must be {opening: [m], pad_z: [m]}");
        }
        if (auto error = config_detail::assign_yaml(file, entry, settings, {})) return error;
        table.push_back(row);
    }
    return std::nullopt;
}

/// Every hull of a list of {member, points}.
std::optional<PlanError> read_parts(const std::filesystem::path& file, const YAML::Node& node,
                                    std::vector<ConvexPart>& parts) {
    using config_detail::bad_value;
    constexpr const char* kRow = "must be {member: palm|finger_left|finger_right, points: [...]}";
    constexpr std::array kMembers = {"palm", "finger_left", "finger_right"};
    if (!node.IsDefined()) return std::nullopt;
    if (!node.IsSequence()) return bad_value(file, node, "convex_parts", kRow);
    for (const YAML::Node& entry : node) {
        const std::string key = "convex_parts[" + std::to_string(parts.size()) + "]";
        if (!entry.IsMap() || !entry["member"].IsDefined() || !entry["points"].IsDefined() ||
            !entry["points"].IsSequence() || entry.size() != 2) {
            return bad_value(file, entry, key, kRow);
        }
        const auto member = std::ranges::find(kMembers, entry["member"].Scalar());
        if (member == kMembers.end())
            return bad_value(file, entry["member"], key + ".member", kRow);
        std::vector<Eigen::Vector3d> points;
        for (const YAML::Node& row : entry["points"]) {
            if (auto bad =
                    config_detail::read_point(file, row, key + ".points", points.emplace_back())) {
                return bad;
            }
        }
        auto hull = hull_points(points);
        if (!hull.ok()) {
            return PlanError{hull.error().code,
                             file.string() + ": " + key + ": " + hull.error().detail};
        }
        parts.push_back(
            {key, static_cast<GripperMember>(member - kMembers.begin()), std::move(hull).value()});
    }
    return std::nullopt;
}

/// A name travels in messages, file names and the wire: it is a plain word.
bool is_word(const std::string& name) {
    const auto fits = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
               c == '_' || c == '-' || c == '.';
    };
    return !name.empty() && name.size() <= 64 && std::ranges::all_of(name, fits);
}

/// A profile of dimensions.
Result<Gripper> load_dimensions(const std::filesystem::path& file, const YAML::Node& root) {
    Gripper gripper;
    const auto settings = gripper_settings(gripper);
    if (auto error = config_detail::assign_yaml(file, root, settings,
                                                {"pad_travel", "convex_parts", "moveit"})) {
        return *std::move(error);
    }
    const auto absent = std::ranges::find_if(
        kRequired, [&](const char* key) { return !root.IsMap() || !root[key].IsDefined(); });
    if (absent != kRequired.end()) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         file.string() + ": key " + *absent + " is missing"};
    }
    if (auto error = read_travel(file, root["pad_travel"], gripper.pad_travel)) {
        return *std::move(error);
    }
    if (auto error = read_parts(file, root["convex_parts"], gripper.convex_parts)) {
        return *std::move(error);
    }
    return gripper;
}

}  // namespace

Result<Gripper> load_gripper(const std::filesystem::path& file) {
    const auto root = config_detail::load_yaml(file);
    if (!root.ok()) return root.error();
    const bool of_urdf = root.value().IsMap() && root.value()["urdf"].IsDefined();
    auto loaded = of_urdf ? config_detail::load_urdf_gripper(file, root.value())
                          : load_dimensions(file, root.value());
    if (!loaded.ok()) return loaded.error();
    Gripper gripper = std::move(loaded).value();
    if (!is_word(gripper.name)) {
        return config_detail::bad_value(file, root.value()["name"], "name",
                                        "must be 1 to 64 of the characters A-Z a-z 0-9 . _ -");
    }
    auto error = validate(gripper);
    if (!error && !of_urdf && !gripper.convex_parts.empty()) {
        fit_boxes(gripper);
        error = validate(gripper);
    }
    if (error) return PlanError{error->code, file.string() + ": " + error->detail};
    return gripper;
}

Result<std::vector<Gripper>> load_grippers(const std::filesystem::path& directory) {
    std::error_code failed;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(directory, failed)) {
        if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    if (files.empty()) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         directory.string() + ": " +
                             (failed ? failed.message() : "holds no gripper profile (*.yaml)")};
    }
    std::ranges::sort(files);  // so that the same error is the first one every time
    std::vector<Gripper> grippers;
    for (const auto& file : files) {
        auto gripper = load_gripper(file);
        if (!gripper.ok()) return gripper.error();
        const auto twin = std::ranges::find(grippers, gripper.value().name, &Gripper::name);
        if (twin != grippers.end()) {
            return PlanError{PlanErrorCode::kInvalidInput,
                             file.string() + ": name = " + gripper.value().name +
                                 " is that of another profile in the same directory"};
        }
        grippers.push_back(std::move(gripper).value());
    }
    std::ranges::sort(grippers, {}, &Gripper::name);
    return grippers;
}

Result<Gripper> find_gripper(const std::string& name_or_file,
                             const std::filesystem::path& directory) {
    if (name_or_file.ends_with(".yaml")) return load_gripper(name_or_file);
    if (name_or_file.ends_with(".urdf")) {
        auto beside = std::filesystem::path(name_or_file).replace_extension(".yaml");
        if (std::filesystem::exists(beside)) return load_gripper(beside);
        return PlanError{PlanErrorCode::kUnreadableFile,
                         "gripper = " + name_or_file +
                             ": a URDF does not say what is palm, finger "
                             "and pad; " +
                             beside.string() + " with the key urdf must (docs/interface.md)"};
    }
    auto grippers = load_grippers(directory);
    if (!grippers.ok()) return grippers.error();
    std::string known;
    for (Gripper& gripper : grippers.value()) {
        // cppcheck-suppress returnStdMoveLocal ; a reference: without the move it is copied
        if (gripper.name == name_or_file) return std::move(gripper);
        known += (known.empty() ? "" : ", ") + gripper.name;
    }
    return PlanError{PlanErrorCode::kUnknownGripper,
                     "gripper = " + name_or_file + " is unknown (known: " + known + ")"};
}

}  // namespace graspd
