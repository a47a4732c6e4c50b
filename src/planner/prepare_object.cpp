#include "prepare_object.hpp"

#include <string_view>

#include "graspd/base/stop.hpp"
#include "graspd/mesh/principal_frame.hpp"

namespace graspd::planner_detail {
namespace {

/// The mesh of the request, or the one that its cloud's points span.
Result<TriangleMesh> surface_of(const std::variant<TriangleMesh, PointCloud>& object,
                                const PlannerConfig& config, StageLog& log,
                                std::vector<Finding>& findings) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&object)) return *mesh;
    const auto& cloud = std::get<PointCloud>(object);
    auto surface = log.run("mesh/triangulate_cloud", cloud.points.size(),
                           [&] { return triangulate_cloud(cloud, config.triangulate_cloud); });
    if (!surface) return surface.error();
    log.out("mesh/triangulate_cloud", surface.value().mesh.faces.size());
    findings = std::move(surface.value().findings);
    return std::move(surface.value().mesh);
}

/// Hull, tree and concavity side by side where they can be, so that their times overlap.
std::optional<PlanError> measure_by_any_angle(PreparedObject& object, const PlannerConfig& config,
                                              StageLog& log) {
    ConcavityConfig steps = config.shortest_path_concavity;
    steps.across_the_void = steps.across_the_void && config.search.exact_concavity;
    steps.slide = steps.slide && config.search.exact_concavity;
    auto measured = measure_concavity(object.mesh_P, steps);
    if (!measured) return measured.error();
    double hull_ms = 0.0, tree_ms = 0.0, field_ms = 0.0;
    for (const StepTime& time : measured.value().times) {
        const std::string_view step = time.step;
        (step == "hull" ? hull_ms : step == "tree" ? tree_ms : field_ms) += time.ms;
    }
    object.hull_P = std::move(measured.value().hull);
    object.tree_P = std::move(measured.value().tree);
    object.field = std::move(measured.value().field);
    const std::size_t vertices = object.mesh_P.vertices.size();
    log.add({"concavity/outer_hull", hull_ms, vertices, object.hull_P.facets.size()});
    log.add({"base/triangle_bvh", tree_ms, object.mesh_P.faces.size(), 1});
    log.add({"concavity/shortest_path_concavity", field_ms, vertices, vertices});
    return std::nullopt;
}

std::optional<PlanError> measure_by_tetrahedra(PreparedObject& object, const PlannerConfig& config,
                                               StageLog& log) {
    auto hull = log.run("concavity/outer_hull", object.mesh_P.vertices.size(),
                        [&] { return outer_hull(object.mesh_P.vertices); });
    if (!hull) return hull.error();
    object.hull_P = std::move(hull).value();
    log.out("concavity/outer_hull", object.hull_P.facets.size());

    object.tree_P = log.run("base/triangle_bvh", object.mesh_P.faces.size(), [&] {
        return std::make_shared<const TriangleBvh>(
            object.mesh_P, ray_tolerance_m(object.mesh_P, config.shortest_path_concavity));
    });
    log.out("base/triangle_bvh", 1);
    constexpr const char* kStage = "concavity/tetrahedral_concavity";
    auto field = log.run(kStage, object.mesh_P.vertices.size(), [&] {
        return tetrahedral_concavity(object.mesh_P, object.hull_P, *object.tree_P,
                                     config.tetrahedral_concavity);
    });
    if (!field) return field.error();
    object.field = std::move(field).value();
    log.out(kStage, object.field.value_m.size());
    return std::nullopt;
}

}  // namespace

Result<PreparedObject> prepare_object(const std::variant<TriangleMesh, PointCloud>& object_O,
                                      const PlannerConfig& config, StageLog& log) {
    PreparedObject object;
    object.settings = settings_of_preparation(config);
    const auto soup = surface_of(object_O, config, log, object.findings);
    if (!soup) return soup.error();
    auto closed = log.run("mesh/condition_mesh", soup.value().faces.size(),
                          [&] { return condition_mesh(soup.value(), config.condition_mesh); });
    if (!closed) return closed.error();
    if (const auto* cloud = std::get_if<PointCloud>(&object_O)) {
        closed = face_sensor(std::move(closed).value(), cloud->sensor_origin, config.condition_mesh,
                             config.face_sensor);
        if (!closed) return closed.error();
    }
    const ConditionedMesh& solid = closed.value();
    log.out("mesh/condition_mesh", solid.mesh.faces.size());
    object.findings.insert(object.findings.end(), solid.findings.begin(), solid.findings.end());
    object.volume_m3 = solid.volume_m3;

    const auto frame = log.run("mesh/principal_frame", solid.mesh.faces.size(),
                               [&] { return principal_frame(solid.mesh); });
    if (!frame) return frame.error();
    log.out("mesh/principal_frame", 1);
    object.X_OP = frame.value();
    stop_point();
    object.mesh_P = transformed(object.X_OP.inverse(), solid.mesh);
    Eigen::AlignedBox3d box_P;
    for (const Eigen::Vector3d& vertex : object.mesh_P.vertices) box_P.extend(vertex);
    object.size_m = box_P.sizes();
    object.center_of_mass_P = object.X_OP.inverse() * solid.center_of_mass;

    stop_point();
    const auto method = concavity_method(config.vertex_concavity);
    if (!method) return method.error();
    const auto bad = method.value() == ConcavityMethod::kAnyAngle
                         ? measure_by_any_angle(object, config, log)
                         : measure_by_tetrahedra(object, config, log);
    if (bad) return *bad;
    object.stages = log.stages();
    for (StageReport& stage : object.stages) stage.ms = 0.0;
    return object;
}

Surroundings::Surroundings(const PlanRequest& request, const PreparedObject& object,
                           const Eigen::Isometry3d& X_WF) {
    bodies_.reserve(request.obstacles.size());
    for (const Obstacle& obstacle : request.obstacles) {
        Body body{transformed(X_WF * obstacle.X_FO, obstacle.mesh), nullptr};
        body.tree = as_stage("base/triangle_bvh", [&] {
            return std::make_unique<TriangleBvh>(body.mesh, 1e-6 * mesh_diagonal_m(body.mesh));
        });
        bodies_.push_back(std::move(body));
    }
    world_.object = {&object.mesh_P, object.tree_P.get()};
    for (const Body& body : bodies_) world_.obstacles.push_back({&body.mesh, body.tree.get()});
    if (request.support_plane) {
        const Eigen::Vector3d normal = X_WF.linear() * request.support_plane->normal_F.normalized();
        world_.plane =
            HalfSpace{normal, request.support_plane->offset_m + normal.dot(X_WF.translation())};
    }
    for (const OrientedBox& box : request.keep_out_F) {
        world_.keep_out.push_back({X_WF * box.pose, box.half_extent});
    }
}

}  // namespace graspd::planner_detail
