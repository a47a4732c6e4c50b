#include "convert_gripper.hpp"

#include <algorithm>

namespace graspd::dds {
namespace {

constexpr std::size_t kMostGrippers = 8;  // the bounds of idl/graspd.idl
constexpr std::size_t kMostTravel = 64;
constexpr std::size_t kMostName = 64;

std::string names_of(std::span<const Gripper> known) {
    std::string text;
    for (const Gripper& gripper : known) text += (text.empty() ? "" : ", ") + gripper.name;
    return text.empty() ? "none" : text;
}

void refuse_meshes(const std::vector<shape_msgs::msg::dds_::Mesh_>& meshes,
                   const std::string& field, FirstError& errors) {
    if (meshes.empty()) return;
    errors.set(PlanErrorCode::kUnsupported, field + " has " + std::to_string(meshes.size()) +
                                                " meshes; convex parts are not served yet");
}

Gripper read_gripper(const wire::Gripper_& in, const std::string& path, FirstError& errors) {
    check_text(in.name(), path + ".name", {1, kMostName}, errors);
    check_count(in.pad_travel().size(), kMostTravel, (path + ".pad_travel").c_str(), errors);
    refuse_meshes(in.palm_meshes(), path + ".palm_meshes", errors);
    refuse_meshes(in.finger_left_meshes(), path + ".finger_left_meshes", errors);
    refuse_meshes(in.finger_right_meshes(), path + ".finger_right_meshes", errors);
    Gripper out{.name = in.name(),
                .min_width_m = in.min_width(),
                .max_width_m = in.max_width(),
                .finger_length_m = in.finger_length(),
                .finger_width_m = in.finger_width(),
                .finger_thickness_m = in.finger_thickness(),
                .tip_offset_m = in.tip_offset(),
                .palm_width_m = in.palm_width(),
                .palm_height_m = in.palm_height(),
                .palm_depth_m = in.palm_depth(),
                .palm_z_m = in.palm_z(),
                .closing_yaw_rad = in.closing_yaw(),
                .pad_travel = {}};
    for (const wire::PadTravel_& row : in.pad_travel()) {
        out.pad_travel.push_back({row.opening(), row.pad_z()});
    }
    if (const auto bad = validate(out)) errors.set(bad->code, path + ": " + bad->detail);
    return out;
}

}  // namespace

std::vector<Gripper> read_grippers(const wire::GraspRequest_& request,
                                   std::span<const Gripper> known, FirstError& errors) {
    const std::string& name = request.gripper();
    const auto& inline_grippers = request.grippers();
    std::vector<Gripper> out;
    if (name.empty() == inline_grippers.empty()) {
        errors.invalid("gripper = " + shown(name) + " and grippers has " +
                       std::to_string(inline_grippers.size()) +
                       " elements; exactly one of the two must be set; known: " + names_of(known));
        return out;
    }
    if (!name.empty()) {
        const auto found = std::ranges::find(known, name, &Gripper::name);
        if (found != known.end()) return {*found};
        errors.set(PlanErrorCode::kUnknownGripper,
                   "gripper = " + shown(name) + " is unknown; known: " + names_of(known));
        return out;
    }
    check_count(inline_grippers.size(), kMostGrippers, "grippers", errors);
    for (std::size_t i = 0; i < inline_grippers.size() && !errors.any(); ++i) {
        Gripper gripper = read_gripper(inline_grippers[i], element("grippers", i), errors);
        if (std::ranges::count(out, gripper.name, &Gripper::name) > 0) {
            errors.invalid(element("grippers", i) + ".name = " + shown(gripper.name) +
                           " is that of an earlier one");
        }
        out.push_back(std::move(gripper));
    }
    return out;
}

wire::Gripper_ write_gripper(const Gripper& gripper) {
    wire::Gripper_ out;
    out.name(gripper.name);
    out.min_width(gripper.min_width_m);
    out.max_width(gripper.max_width_m);
    out.finger_length(gripper.finger_length_m);
    out.finger_width(gripper.finger_width_m);
    out.finger_thickness(gripper.finger_thickness_m);
    out.tip_offset(gripper.tip_offset_m);
    out.palm_width(gripper.palm_width_m);
    out.palm_height(gripper.palm_height_m);
    out.palm_depth(gripper.palm_depth_m);
    out.palm_z(gripper.palm_z_m);
    out.closing_yaw(gripper.closing_yaw_rad);
    for (const PadTravel& row : gripper.pad_travel) {
        wire::PadTravel_ entry;
        entry.opening(row.opening_m);
        entry.pad_z(row.pad_z_m);
        out.pad_travel().push_back(entry);
    }
    return out;
}

}  // namespace graspd::dds
