#include "convert_request.hpp"

#include <numbers>

#include "convert_cloud.hpp"
#include "convert_gripper.hpp"
#include "convert_options.hpp"

namespace graspd::dds {
namespace {

// The bounds of idl/graspd.idl.
constexpr std::size_t kMostId = 64;
constexpr std::size_t kMostObstacles = 64;
constexpr std::size_t kMostCones = 64;
constexpr std::size_t kMostBoxes = 64;

void check_names(const wire::GraspRequest_& in, FirstError& errors) {
    check_text(in.request_id(), "request_id", {1, kMostId}, errors);
    check_text(in.client_id(), "client_id", {0, kMostId}, errors);
    check_text(in.object_key(), "object_key", {0, kMostId}, errors);
    check_text(in.header().frame_id(), "header.frame_id", {0, kMostFrameId}, errors);
}

void check_object_choice(const wire::GraspRequest_& in, const TriangleMesh& mesh_O,
                         FirstError& errors) {
    const bool mesh = !mesh_O.vertices.empty() || !mesh_O.faces.empty();
    const bool cloud = !is_empty(in.cloud());
    const bool key = !in.object_key().empty();
    if (mesh + cloud + key != 1) {
        const std::string set =
            std::string(mesh ? " mesh" : "") + (cloud ? " cloud" : "") + (key ? " object_key" : "");
        errors.invalid("exactly one of mesh, cloud and object_key must be set, not:" +
                       (set.empty() ? " none" : set));
    }
    if (!in.sensor_origin().empty() && !cloud) {
        errors.invalid("sensor_origin is set although there is no cloud");
    }
    const std::string& frame = in.cloud().header().frame_id();
    if (cloud && !frame.empty() && frame != in.header().frame_id()) {
        errors.invalid("cloud.header.frame_id = " + shown(frame) +
                       " must be empty or header.frame_id = " + shown(in.header().frame_id()));
    }
}

void read_object(const wire::GraspRequest_& in, const TriangleMesh& mesh_O, PlanRequest& out,
                 FirstError& errors) {
    check_object_choice(in, mesh_O, errors);
    check_count(in.sensor_origin().size(), 1, "sensor_origin", errors);
    check_count(in.object_pose().size(), 1, "object_pose", errors);
    if (errors.any()) return;
    if (!in.object_pose().empty()) {
        out.X_FO = read_pose(in.object_pose().front(), "object_pose[0]", errors);
    }
    if (is_empty(in.cloud())) {
        out.object_O = mesh_O;
        return;
    }
    PointCloud cloud{read_cloud(in.cloud(), "cloud", errors), {}};
    if (!in.sensor_origin().empty()) {
        cloud.sensor_origin = read_finite(in.sensor_origin().front(), "sensor_origin[0]", errors);
    }
    out.object_O = std::move(cloud);
}

/// Everything around the object that limits the gripper.
void read_scene(const wire::GraspRequest_& in, PlanRequest& out, FirstError& errors) {
    check_count(in.support_plane().size(), 1, "support_plane", errors);
    check_count(in.obstacles().size(), kMostObstacles, "obstacles", errors);
    check_count(in.approach_cones().size(), kMostCones, "approach_cones", errors);
    check_count(in.keep_out_boxes().size(), kMostBoxes, "keep_out_boxes", errors);
    if (!is_empty(in.obstacle_cloud())) {
        errors.set(PlanErrorCode::kUnsupported,
                   "obstacle_cloud of " + std::to_string(in.obstacle_cloud().width()) + " x " +
                       std::to_string(in.obstacle_cloud().height()) + " points is not served yet");
    }
    if (errors.any()) return;
    for (const wire::SupportPlane_& plane : in.support_plane()) {
        out.support_plane = {
            read_unit(plane.normal(), "support_plane[0].normal", errors),
            read_number(plane.offset(), "support_plane[0].offset", {-kLargest, kLargest}, errors)};
    }
    for (std::size_t i = 0; i < in.obstacles().size(); ++i) {
        const wire::Obstacle_& obstacle = in.obstacles()[i];
        const std::string path = element("obstacles", i);
        if (is_empty(obstacle.mesh())) errors.invalid(path + ".mesh has no vertices");
        out.obstacles.push_back(
            {read_mesh(obstacle.mesh()), read_pose(obstacle.pose(), path + ".pose", errors)});
    }
    for (std::size_t i = 0; i < in.approach_cones().size(); ++i) {
        const wire::ApproachCone_& cone = in.approach_cones()[i];
        const std::string path = element("approach_cones", i);
        out.approach_cones.push_back({read_unit(cone.axis(), path + ".axis", errors),
                                      read_number(cone.half_angle(), path + ".half_angle",
                                                  {0.0, std::numbers::pi, true}, errors)});
    }
    for (std::size_t i = 0; i < in.keep_out_boxes().size(); ++i) {
        const wire::KeepOutBox_& box = in.keep_out_boxes()[i];
        const std::string path = element("keep_out_boxes", i);
        const Eigen::Vector3d size = read_finite(box.size(), path + ".size", errors);
        read_number(size.minCoeff(), path + ".size", kPositive, errors);
        out.keep_out_F.push_back({read_pose(box.pose(), path + ".pose", errors), size / 2.0});
    }
}

void write_object(const PlanRequest& in, wire::GraspRequest_& out, FirstError& errors) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&in.object_O)) {
        out.mesh(write_mesh(*mesh));
        return;
    }
    const auto& cloud = std::get<PointCloud>(in.object_O);
    out.cloud(write_cloud(cloud.points, errors));
    out.cloud().header().frame_id(in.frame_id);
    if (cloud.sensor_origin) out.sensor_origin().push_back(write_point(*cloud.sensor_origin));
}

void write_scene(const PlanRequest& in, wire::GraspRequest_& out) {
    if (in.support_plane) {
        wire::SupportPlane_ plane;
        plane.normal(write_vector(in.support_plane->normal_F));
        plane.offset(in.support_plane->offset_m);
        out.support_plane().push_back(plane);
    }
    for (const Obstacle& obstacle : in.obstacles) {
        wire::Obstacle_& entry = out.obstacles().emplace_back();
        entry.mesh(write_mesh(obstacle.mesh));
        entry.pose(write_pose(obstacle.X_FO));
    }
    for (const ApproachCone& cone : in.approach_cones) {
        wire::ApproachCone_& entry = out.approach_cones().emplace_back();
        entry.axis(write_vector(cone.axis_F));
        entry.half_angle(cone.half_angle_rad);
    }
    for (const OrientedBox& box : in.keep_out_F) {
        wire::KeepOutBox_& entry = out.keep_out_boxes().emplace_back();
        entry.pose(write_pose(box.pose));
        entry.size(write_vector(box.half_extent * 2.0));
    }
}

}  // namespace

Result<PlanRequest> read_request(const wire::GraspRequest_& request,
                                 std::span<const Gripper> known) {
    return read_request(request, read_mesh(request.mesh()), known);
}

Result<PlanRequest> read_request(const wire::GraspRequest_& request, const TriangleMesh& mesh_O,
                                 std::span<const Gripper> known) {
    PlanRequest out;
    FirstError errors;
    check_names(request, errors);
    out.request_id = request.request_id();
    out.frame_id = request.header().frame_id();
    out.options = read_options(request, errors);
    if (!errors.any()) out.grippers = read_grippers(request, known, errors);
    if (!errors.any()) read_scene(request, out, errors);
    if (!errors.any()) read_object(request, mesh_O, out, errors);
    if (errors.any()) return *errors.error();
    return out;
}

Result<wire::GraspRequest_> write_request(const PlanRequest& request,
                                          const std::string& client_id) {
    wire::GraspRequest_ out;
    FirstError errors;
    out.header().frame_id(request.frame_id);
    out.client_id(client_id);
    out.request_id(request.request_id);
    check_names(out, errors);
    write_object(request, out, errors);
    if (!request.X_FO.matrix().isIdentity(0.0)) {
        out.object_pose().push_back(write_pose(request.X_FO));
    }
    for (const Gripper& gripper : request.grippers) {
        out.grippers().push_back(write_gripper(gripper));
    }
    write_scene(request, out);
    out.options().push_back(write_options(request.options));
    if (errors.any()) return *errors.error();
    return out;
}

}  // namespace graspd::dds
