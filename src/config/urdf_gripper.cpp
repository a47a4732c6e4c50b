#include "urdf_gripper.hpp"

#include <algorithm>
#include <cmath>

#include "urdf_model.hpp"

namespace graspd::config_detail {
namespace {

constexpr const char* kKeys =
    "name, urdf, mount_link, driver_joint, open, closed, palm_links, left_links, right_links, "
    "left_pad, right_pad, pad_width, pad_height";

std::optional<PlanError> read_links(const std::filesystem::path& file, const YAML::Node& root,
                                    const char* key, std::vector<std::string>& links) {
    const YAML::Node node = root[key];
    if (!node.IsDefined()) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         file.string() + ": key " + key + " is missing"};
    }
    const bool list = node.IsSequence() && node.size() > 0;
    if (!list || !std::ranges::all_of(node, [](const YAML::Node& n) { return n.IsScalar(); })) {
        return bad_value(file, node, key, "must be a list of the names of links");
    }
    for (const YAML::Node& link : node) links.push_back(link.Scalar());
    return std::nullopt;
}

std::optional<PlanError> read_pad(const std::filesystem::path& file, const YAML::Node& root,
                                  const char* key, std::string& link, Eigen::Vector3d& point) {
    const YAML::Node node = root[key];
    if (!node.IsDefined() || !node.IsMap() || !node["link"].IsDefined() ||
        !node["point"].IsDefined()) {
        return bad_value(file, node.IsDefined() ? node : root, key,
                         "must be {link: NAME, point: [x, y, z]}, the middle of the pad's face");
    }
    for (const auto& entry : node) {
        const std::string& name = entry.first.Scalar();
        if (name != "link" && name != "point") {
            return unknown_key(file, entry.first, std::string(key) + "." + name, "link, point");
        }
    }
    link = node["link"].Scalar();
    return read_point(file, node["point"], std::string(key) + ".point", point);
}

/// Pads must face each other across H's z axis, on which G's origin runs.
std::optional<PlanError> set_closing_axis(const std::filesystem::path& file, Linkage& linkage,
                                          Gripper& gripper) {
    constexpr double kAside_m = 5e-4;
    const Eigen::Vector3d left = pad_point_H(linkage, 0, linkage.open_q);
    const Eigen::Vector3d right = pad_point_H(linkage, 1, linkage.open_q);
    const Eigen::Vector3d middle = 0.5 * (left + right), across = right - left;
    const double aside_m = std::max(middle.head<2>().norm(), std::abs(across.z()));
    if (aside_m > kAside_m || !(across.head<2>().norm() > kAside_m)) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         file.string() +
                             ": left_pad and right_pad, open, are not opposite across "
                             "the z axis of mount_link: off by " +
                             std::to_string(aside_m) + " m, apart by " +
                             std::to_string(across.head<2>().norm()) + " m"};
    }
    gripper.closing_yaw_rad = std::atan2(across.y(), across.x());
    linkage.closing_axis_H = {std::cos(gripper.closing_yaw_rad), std::sin(gripper.closing_yaw_rad),
                              0.0};
    return std::nullopt;
}

/// The pads' way as a table, for what asks the boxes.
void tabulate_travel(Gripper& gripper) {
    constexpr int kRows = 64;
    const Linkage& linkage = *gripper.linkage;
    for (int i = 0; i < kRows; ++i) {
        const double share = static_cast<double>(i) / (kRows - 1);
        const double q = linkage.closed_q + share * (linkage.open_q - linkage.closed_q);
        gripper.pad_travel.push_back(
            {pad_gap_m(linkage, q),
             0.5 * (pad_point_H(linkage, 0, q).z() + pad_point_H(linkage, 1, q).z())});
    }
    gripper.min_width_m = gripper.pad_travel.front().opening_m;
    gripper.max_width_m = gripper.pad_travel.back().opening_m;
}

}  // namespace

std::optional<PlanError> read_point(const std::filesystem::path& file, const YAML::Node& node,
                                    const std::string& key, Eigen::Vector3d& point) {
    bool good = node.IsSequence() && node.size() == 3;
    for (std::size_t i = 0; good && i < 3; ++i) {
        good = parse_scalar(node[i], point[static_cast<Eigen::Index>(i)]);
    }
    if (good) return std::nullopt;
    return bad_value(file, node, key, "must be three numbers [m]");
}

Result<Gripper> load_urdf_gripper(const std::filesystem::path& file, const YAML::Node& root) {
    Gripper gripper;
    UrdfNames names;
    std::string urdf;
    double open = std::nan(""), closed = std::nan("");
    const std::vector<SettingRef> settings = {{{"name"}, &gripper.name, ""},
                                              {{"urdf"}, &urdf, ""},
                                              {{"mount_link"}, &names.mount_link, ""},
                                              {{"driver_joint"}, &names.driver_joint, ""},
                                              {{"open"}, &open, ""},
                                              {{"closed"}, &closed, ""},
                                              {{"pad_width"}, &gripper.pad_width_m, ""},
                                              {{"pad_height"}, &gripper.pad_height_m, ""}};
    if (auto error = assign_yaml(
            file, root, settings,
            {"palm_links", "left_links", "right_links", "left_pad", "right_pad", "moveit"})) {
        return *std::move(error);
    }
    for (const char* key : {"name", "mount_link", "driver_joint", "pad_width", "pad_height"}) {
        if (root[key].IsDefined()) continue;
        return PlanError{
            PlanErrorCode::kInvalidInput,
            file.string() + ": key " + key + " is missing (a profile with urdf has " + kKeys + ")"};
    }
    using enum GripperMember;
    std::array<Eigen::Vector3d, 2> points;
    if (auto bad = read_links(file, root, "palm_links", names.links[kPalm])) return *std::move(bad);
    if (auto bad = read_links(file, root, "left_links", names.links[kFingerLeft]))
        return *std::move(bad);
    if (auto bad = read_links(file, root, "right_links", names.links[kFingerRight]))
        return *std::move(bad);
    if (auto bad = read_pad(file, root, "left_pad", names.left_pad_link, points[0]))
        return *std::move(bad);
    if (auto bad = read_pad(file, root, "right_pad", names.right_pad_link, points[1]))
        return *std::move(bad);

    auto model = read_urdf(file.parent_path() / urdf, names);
    if (!model.ok()) return model.error();
    Linkage& linkage = model.value().linkage;
    for (std::size_t i = 0; i < 2; ++i) linkage.pads[i].point = points[i];
    if (std::isfinite(open)) linkage.open_q = open;
    if (std::isfinite(closed)) linkage.closed_q = closed;
    if (auto bad = set_closing_axis(file, linkage, gripper)) return *std::move(bad);
    if (auto bad = validate(linkage)) {
        return PlanError{bad->code, file.string() + ": " + bad->detail};
    }
    gripper.linkage = std::move(linkage);
    gripper.convex_parts = std::move(model.value().parts);
    tabulate_travel(gripper);
    fit_boxes(gripper);
    return gripper;
}

}  // namespace graspd::config_detail
