#include "convert_gripper.hpp"

#include <algorithm>
#include <utility>

#include "graspd/base/hull_points.hpp"

namespace graspd::dds {
namespace {

constexpr std::size_t kMostGrippers = 8;  // the bounds of idl/graspd.idl
constexpr std::size_t kMostTravel = 64;
constexpr std::size_t kMostName = 64;
constexpr std::size_t kMostParts = 16;

using Meshes = std::vector<shape_msgs::msg::dds_::Mesh_>;

/// A member's convex parts; of a mesh the vertices alone count.
void read_parts(const Meshes& meshes, GripperMember member, const std::string& field,
                FirstError& errors, std::vector<ConvexPart>& parts) {
    check_count(meshes.size(), kMostParts, field, errors);
    for (std::size_t i = 0; i < meshes.size() && !errors.any(); ++i) {
        const std::string path = element(field, i);
        const TriangleMesh mesh = read_mesh(meshes[i]);
        const bool finite = std::ranges::all_of(
            mesh.vertices, [](const Eigen::Vector3d& vertex) { return vertex.allFinite(); });
        if (!finite) return errors.invalid(path + " has a vertex that is not finite");
        auto hull = hull_points(mesh.vertices);
        if (!hull.ok()) {
            return errors.invalid(path + ": " + hull.error().detail +
                                  "; 4 or more that do not lie in one plane are needed");
        }
        parts.push_back({path, member, std::move(hull).value()});
    }
}

Gripper read_gripper(const wire::Gripper_& in, const std::string& path, FirstError& errors) {
    check_text(in.name(), path + ".name", {1, kMostName}, errors);
    check_count(in.pad_travel().size(), kMostTravel, path + ".pad_travel", errors);
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
                .pad_travel = {},
                .pad_width_m = 0.0,
                .pad_height_m = 0.0,
                .convex_parts = {},
                .linkage = {}};
    for (const wire::PadTravel_& row : in.pad_travel()) {
        out.pad_travel.push_back({row.opening(), row.pad_z()});
    }
    using enum GripperMember;
    read_parts(in.palm_meshes(), kPalm, path + ".palm_meshes", errors, out.convex_parts);
    read_parts(in.finger_left_meshes(), kFingerLeft, path + ".finger_left_meshes", errors,
               out.convex_parts);
    read_parts(in.finger_right_meshes(), kFingerRight, path + ".finger_right_meshes", errors,
               out.convex_parts);
    auto bad = validate(out);
    if (!bad && !out.convex_parts.empty()) {
        fit_boxes(out);
        bad = validate(out);
    }
    if (bad) errors.set(bad->code, path + ": " + bad->detail);
    return out;
}

/// The reader grows the boxes to hold the parts, so the finger's box tells the pad's size.
void write_parts(const Gripper& gripper, wire::Gripper_& out) {
    const Eigen::Vector2d pad = pad_half_size_m(gripper);
    out.finger_width(2.0 * pad.x());
    out.tip_offset(pad.y());
    for (const ConvexPart& part : gripper.convex_parts) {
        const auto mesh = write_mesh({part.points, {}});
        switch (part.member) {
            case GripperMember::kPalm: out.palm_meshes().push_back(mesh); break;
            case GripperMember::kFingerLeft: out.finger_left_meshes().push_back(mesh); break;
            case GripperMember::kFingerRight: out.finger_right_meshes().push_back(mesh); break;
        }
    }
}

}  // namespace

std::string names_of(std::span<const Gripper> known) {
    std::string text;
    for (const Gripper& gripper : known) text += (text.empty() ? "" : ", ") + gripper.name;
    return text.empty() ? "none" : text;
}

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
    if (!gripper.linkage && !gripper.convex_parts.empty()) write_parts(gripper, out);
    for (const PadTravel& row : gripper.pad_travel) {
        wire::PadTravel_ entry;
        entry.opening(row.opening_m);
        entry.pad_z(row.pad_z_m);
        out.pad_travel().push_back(entry);
    }
    return out;
}

}  // namespace graspd::dds
