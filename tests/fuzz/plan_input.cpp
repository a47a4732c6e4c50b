#include "plan_input.hpp"

#include <cmath>
#include <numbers>

#include "byte_reader.hpp"
#include "graspd/base/hull_points.hpp"
#include "support/shapes.hpp"

namespace graspd::fuzz {
namespace {

using Eigen::Vector3d;

Vector3d vector_in(ByteReader& from, double least, double greatest) {
    Vector3d out;
    for (double& value : out) value = from.between(least, greatest);
    return out;
}

Vector3d unit_from(ByteReader& from) {
    const Vector3d out = vector_in(from, -1.0, 1.0);
    return out.norm() > 1e-3 ? out.normalized() : Vector3d(-Vector3d::UnitZ());
}

Eigen::Isometry3d pose_from(ByteReader& from) {
    const double turn_rad = from.between(0.0, 2.0 * std::numbers::pi);
    const Vector3d axis = unit_from(from);
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = Eigen::AngleAxisd(turn_rad, axis).toRotationMatrix();
    out.translation() = vector_in(from, -1.0, 1.0);
    return out;
}

TriangleMesh shape_from(ByteReader& from) {
    const unsigned kind = from.number(0, 9);
    const double a = from.between(0.01, 0.08), b = from.between(0.01, 0.15);
    const double thin = from.between(0.003, 0.015);
    const std::size_t faces = from.number(12, 200);
    switch (kind) {
        case 0: return test::box({a, b, from.between(0.01, 0.1)}, faces);
        case 1: return test::sphere(a / 2.0, faces);
        case 2: return test::cylinder(a / 2.0, b, faces);
        case 3: return test::u_channel(b, a, thin, 0.06, faces);
        case 4: return test::wedge(a, thin, 0.05, b, faces);
        case 5: return test::l_shape(a + 2.0 * thin, b + 2.0 * thin, thin, 0.04, faces);
        case 6: return test::hourglass(a, thin, b, thin, faces);
        case 7: return test::torus(a, thin, faces);
        case 8: return test::cup(a + thin, b + thin, thin, faces);
        default: return test::plate_with_hole({b + 0.03, b + 0.03, thin}, 0.01, faces);
    }
}

void build_object(ByteReader& from, PlanRequest& request) {
    TriangleMesh mesh = shape_from(from);
    if (from.flag()) {
        const TriangleMesh second = shape_from(from);
        mesh = test::joined(mesh, test::moved(second, pose_from(from)));
    }
    if (from.number(0, 3) == 3) {
        PointCloud cloud;
        cloud.points = std::move(mesh.vertices);
        if (from.flag()) cloud.sensor_origin = vector_in(from, -1.0, 1.0);
        request.object_O = std::move(cloud);
    } else {
        request.object_O = std::move(mesh);
    }
    if (from.flag()) request.X_FO = pose_from(from);
}

Gripper gripper_from(ByteReader& from, unsigned index) {
    Gripper out;
    out.name = "gripper_" + std::to_string(index);
    if (from.flag()) {
        out.max_width_m = from.between(0.01, 0.2);
        out.min_width_m = from.between(0.0, out.max_width_m);
        out.finger_length_m = from.between(0.01, 0.1);
        out.finger_width_m = from.between(0.005, 0.05);
        out.finger_thickness_m = from.between(0.002, 0.03);
        out.tip_offset_m = from.between(0.0, out.finger_length_m);
        out.palm_width_m = from.between(0.02, 0.2);
        out.palm_height_m = from.between(0.01, 0.1);
        out.palm_depth_m = from.between(0.01, 0.1);
        out.palm_z_m = from.between(-0.05, 0.05);
        out.closing_yaw_rad = from.between(-4.0, 4.0);
        out.pad_width_m = from.between(0.0, 0.03);
        out.pad_height_m = from.between(0.0, 0.03);
    }
    for (unsigned rows = from.number(0, 3), i = 0; i < rows; ++i) {
        const double share = (i + 1.0) / rows;
        out.pad_travel.push_back({share * out.max_width_m, from.between(0.0, 0.2)});
    }
    if (from.number(0, 3) == 3) {
        const TriangleMesh part = test::moved(test::box({0.03, 0.02, 0.05}), pose_from(from));
        const auto member = static_cast<GripperMember>(from.number(0, 2));
        out.convex_parts.push_back({"part", member, part.vertices});
        fit_boxes(out);
    }
    return out;
}

void build_scene(ByteReader& from, PlanRequest& request) {
    if (from.flag()) request.support_plane = SupportPlane{unit_from(from), from.between(-1, 1)};
    for (unsigned n = from.number(0, 2); n > 0; --n) {
        request.obstacles.push_back({test::box(vector_in(from, 0.01, 0.3)), pose_from(from)});
    }
    for (unsigned n = from.number(0, 2); n > 0; --n) {
        request.approach_cones.push_back({unit_from(from), from.between(0.01, std::numbers::pi)});
    }
    for (unsigned n = from.number(0, 2); n > 0; --n) {
        request.keep_out_F.push_back({pose_from(from), vector_in(from, 0.001, 0.2)});
    }
}

/// Hand poses to be judged, near the object.
void build_candidates(ByteReader& from, PlanRequest& request) {
    if (from.number(0, 3) != 3) return;
    for (unsigned n = from.number(1, 3); n > 0; --n) {
        Eigen::Isometry3d pose = pose_from(from);
        pose.translation() *= 0.15;
        request.candidates_FH.push_back(pose);
    }
}

PlanOptions options_from(ByteReader& from) {
    PlanOptions out;
    out.max_grasps = from.number(1, 20);
    out.friction = from.between(0.05, 2.0);
    if (from.flag()) out.min_clearance_m = from.between(0.0, 0.02);
    if (from.flag()) out.mass_kg = from.between(0.001, 5.0);
    if (from.flag()) out.center_of_mass_O = vector_in(from, -0.1, 0.1);
    if (from.flag()) out.gravity_F = unit_from(from);
    out.grip_force_N = from.between(1.0, 100.0);
    out.sources = static_cast<std::uint8_t>(from.number(0, 7));
    out.want_suggestion = from.number(0, 7) == 7;
    out.seed = from.byte();
    return out;
}

/// As few rounds of everything as there may be.
PlannerConfig small_config(ByteReader& from) {
    PlannerConfig config;
    config.condition_mesh.alpha_wrap = from.number(0, 255) == 255;  // takes a hundred times as long
    config.condition_mesh.wrap_alpha = 0.3;
    config.condition_mesh.wrap_offset = 0.03;
    config.triangulate_cloud.greedy_projection = from.number(0, 15) == 15;
    config.sample_surface.max_samples = from.number(100, 250);
    config.cluster_concavities.max_concavities = 2;
    config.guess_units.refuse = from.number(0, 3) == 3;  // else sizes far off get no further
    SearchConfig& search = config.search;
    search.levels = from.number(1, 2);
    search.planes = 1;
    search.approaches = from.number(1, 3);
    search.insertions = from.number(1, 2);
    search.probe_samples = 100;
    search.axes_per_round = 2;
    search.poses_per_round = 5;
    search.refined = from.number(0, 1);
    search.refine_rounds = 1;
    search.tolerances = from.number(0, 1);
    search.tolerance_halvings = 1;
    config.suggest.bisections = from.number(0, 1);
    return config;
}

double& chosen_coordinate(ByteReader& from, std::vector<Vector3d>& points) {
    const std::size_t i = from.word();
    return points[i % points.size()][static_cast<Eigen::Index>(from.number(0, 2))];
}

void damage_object(ByteReader& from, PlanRequest& request) {
    auto* mesh = std::get_if<TriangleMesh>(&request.object_O);
    auto& points = mesh != nullptr ? mesh->vertices : std::get<PointCloud>(request.object_O).points;
    if (points.empty()) return;
    const unsigned kind = from.number(0, 6);
    if (kind == 0) chosen_coordinate(from, points) = from.any();
    if (kind == 1) chosen_coordinate(from, points) += from.between(-0.02, 0.02);
    if (kind == 2) {
        const double factor = std::pow(10.0, from.between(-12.0, 12.0));
        for (Vector3d& point : points) point *= factor;
    }
    if (kind == 3) {
        const Vector3d direction = unit_from(from);
        const Vector3d shift = direction * std::pow(10.0, from.between(-3.0, 9.0));
        for (Vector3d& point : points) point += shift;
    }
    if (kind == 4) points.resize(points.size() * from.byte() / 256);
    if (mesh == nullptr || mesh->faces.empty()) return;
    Triangle& face = mesh->faces[from.word() % mesh->faces.size()];
    if (kind == 5) face[from.number(0, 2)] = from.number(0, 255);
    if (kind == 6 && from.flag()) std::swap(face[0], face[1]);
    if (kind == 6 && from.flag()) mesh->faces.push_back(face);
    if (kind == 6 && from.flag()) mesh->faces.resize(mesh->faces.size() * from.byte() / 256);
}

/// Every number of the options, the pose and the first of each kind of thing around.
std::vector<double*> numbers_of(PlanRequest& request) {
    PlanOptions& options = request.options;
    std::vector<double*> out = {&options.time_budget_s, &options.friction, &options.min_clearance_m,
                                &options.grip_force_N};
    if (options.mass_kg) out.push_back(&*options.mass_kg);
    const auto add = [&](Vector3d& vector) {
        for (double& value : vector) out.push_back(&value);
    };
    const auto add_pose = [&](Eigen::Isometry3d& pose) {
        for (Eigen::Index i = 0; i < 12; ++i) out.push_back(&pose.matrix()(i % 3, i / 3));
    };
    if (options.center_of_mass_O) add(*options.center_of_mass_O);
    if (options.gravity_F) add(*options.gravity_F);
    add_pose(request.X_FO);
    for (Eigen::Isometry3d& pose : request.candidates_FH) add_pose(pose);
    if (request.support_plane) {
        add(request.support_plane->normal_F);
        out.push_back(&request.support_plane->offset_m);
    }
    for (Obstacle& obstacle : request.obstacles) {
        add_pose(obstacle.X_FO);
        for (Vector3d& vertex : obstacle.mesh.vertices) add(vertex);
    }
    for (ApproachCone& cone : request.approach_cones) {
        add(cone.axis_F);
        out.push_back(&cone.half_angle_rad);
    }
    for (OrientedBox& box : request.keep_out_F) {
        add_pose(box.pose);
        add(box.half_extent);
    }
    for (Gripper& gripper : request.grippers) {
        for (double* value : {&gripper.min_width_m, &gripper.max_width_m, &gripper.finger_length_m,
                              &gripper.finger_width_m, &gripper.finger_thickness_m,
                              &gripper.tip_offset_m, &gripper.palm_width_m, &gripper.palm_height_m,
                              &gripper.palm_depth_m, &gripper.palm_z_m, &gripper.closing_yaw_rad,
                              &gripper.pad_width_m, &gripper.pad_height_m}) {
            out.push_back(value);
        }
        for (PadTravel& row : gripper.pad_travel) {
            out.push_back(&row.opening_m);
            out.push_back(&row.pad_z_m);
        }
        for (ConvexPart& part : gripper.convex_parts) {
            for (Vector3d& point : part.points) add(point);
        }
    }
    return out;
}

void damage_number(ByteReader& from, PlanRequest& request) {
    const auto numbers = numbers_of(request);
    double& chosen = *numbers[from.word() % numbers.size()];
    switch (from.number(0, 3)) {
        case 0: chosen = from.any(); break;
        case 1: chosen *= std::pow(10.0, from.between(-12.0, 12.0)); break;
        case 2: chosen = from.between(-2.0, 2.0); break;
        default: chosen = 0.0; break;
    }
}

}  // namespace

PlanInput make_plan_input(Bytes bytes) {
    ByteReader from(bytes);
    PlanInput out;
    PlanRequest& request = out.request;
    request.request_id = "fuzzed";
    request.frame_id = "world";
    const unsigned damages = from.number(0, 4);
    out.config = small_config(from);
    out.twice = from.number(0, 3) == 0;  // most are not, so that there are more of them
    // A plan without a grasp looks for a suggestion, by planning again some dozen times.
    if (from.number(0, 7) != 0) out.stop_after = 1u << from.number(0, 14);
    build_object(from, request);
    const unsigned grippers = from.number(1, 2);
    for (unsigned i = 0; i < grippers; ++i) request.grippers.push_back(gripper_from(from, i));
    build_scene(from, request);
    build_candidates(from, request);
    request.options = options_from(from);
    for (unsigned rest = damages; rest > 0; --rest) {
        if (from.flag()) {
            damage_object(from, request);
        } else {
            damage_number(from, request);
        }
    }
    return out;
}

}  // namespace graspd::fuzz
