// What each of the paper's stages makes of an object, as JSON for scripts/concept_pictures.
//
//   paper_stages MESH [CONCAVITY [SHARE]]
//
// CONCAVITY 0 is the deepest region that the first threshold gives. The stages run as planner.cpp
// runs them, with the settings built in. Lengths in metres, points in the frame O of the file.
#include <iostream>
#include <nlohmann/json.hpp>

#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/contour/boundary_points.hpp"
#include "graspd/contour/concave_hull.hpp"
#include "graspd/contour/order_boundary.hpp"
#include "graspd/contour/project_points.hpp"
#include "graspd/grasp/force_balance.hpp"
#include "graspd/grasp/grasp_sides.hpp"
#include "graspd/grasp/local_cloud.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/read_object.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/planner/planner.hpp"
#include "graspd/regions/cluster_concavities.hpp"
#include "graspd/regions/concavity_frame.hpp"
#include "value_of.hpp"

namespace {

using namespace graspd;
using bench::value_of;
using Json = nlohmann::json;
using Points2 = std::vector<Eigen::Vector2d>;
using Points3 = std::vector<Eigen::Vector3d>;

constexpr double kPreshapeMargin_m = 0.01;  // on each side of the object, as manipulability's

template <class Points>
Json json_of(const Points& points) {
    Json rows = Json::array();
    for (const auto& point : points)
        rows.push_back(std::vector<double>(point.begin(), point.end()));
    return rows;
}

Json json_of_pose(const Eigen::Isometry3d& pose) {
    const Eigen::Matrix3d axes = pose.linear();
    return {{"origin", {pose.translation().x(), pose.translation().y(), pose.translation().z()}},
            {"axes", json_of(Points3{axes.col(0), axes.col(1), axes.col(2)})}};
}

/// II-A: the mesh, its concavity, and the longest way out.
Json concavity_of(const TriangleMesh& mesh, const MeasuredConcavity& measured) {
    const auto& values = measured.field.value_m;
    Json faces = Json::array();
    for (const auto& face : mesh.faces) faces.push_back({face[0], face[1], face[2]});
    std::uint32_t deepest = 0;
    for (std::uint32_t v = 0; v < values.size(); ++v) {
        if (std::isfinite(values[v]) && values[v] > values[deepest]) deepest = v;
    }
    return {{"vertices", json_of(mesh.vertices)},
            {"faces", faces},
            {"concavity", values},
            {"deepest_way", json_of(escape_path(mesh, measured.hull, measured.field, deepest))}};
}

Points3 points_of(const SurfaceSamples& surface, const std::vector<std::uint32_t>& indices) {
    Points3 points;
    for (const std::uint32_t i : indices) points.push_back(surface.samples[i].point);
    return points;
}

/// II-C to II-E on the best plane pair of one concavity.
Json boundary_of(const Points3& salient, const Points3& enlarged, double spacing_m,
                 const TriangleBvh& tree, const Gripper& gripper) {
    const PlannerConfig config;
    const auto frame =
        value_of(concavity_frame(salient, tree, gripper.finger_length_m, config.concavity_frame));
    const Eigen::Isometry3d& X_OW = frame.planes[0].X_OW;
    const Points2 cluster_W = project_points(salient, X_OW);
    const Points2 enlarged_W = project_points(enlarged, X_OW);
    const auto outline = [&](const Points2& points) {
        return value_of(concave_hull(points, spacing_m, config.concave_hull)).outline;
    };
    const Points2 cluster_outline = outline(cluster_W), enlarged_outline = outline(enlarged_W);
    const Points2 boundary = order_boundary(value_of(
        boundary_points(cluster_outline, enlarged_outline, spacing_m, config.boundary_points)));
    const double step_m = config.step_points.step_finger_widths * gripper.finger_width_m;
    const double max_gap_m = config.step_points.max_gap_spacings * spacing_m;
    const auto steps =
        value_of(step_points(boundary, step_m, std::max(gripper.min_width_m, step_m), max_gap_m));
    Points2 step_W;
    for (const StepPoint& step : steps) step_W.push_back(step.point);
    Json candidates = Json::array();
    for (const auto& candidate : value_of(grasp_candidates(boundary, steps, gripper.max_width_m,
                                                           max_gap_m, config.grasp_candidates))) {
        candidates.push_back(json_of(Points2{candidate.left_W, candidate.right_W}));
    }
    return {{"box", json_of_pose(frame.X_OC)},
            {"half_extent",
             {frame.half_extent_m.x(), frame.half_extent_m.y(), frame.half_extent_m.z()}},
            {"plane", json_of_pose(X_OW)},
            {"cluster", json_of(cluster_W)},
            {"enlarged", json_of(enlarged_W)},
            {"cluster_outline", json_of(cluster_outline)},
            {"enlarged_outline", json_of(enlarged_outline)},
            {"boundary", json_of(boundary)},
            {"steps", json_of(step_W)},
            {"step", step_m},
            {"candidates", candidates}};
}

/// II-F: the sides that the pads of a planned grasp see, and the angle between their lines.
Json balance_of(const Grasp& grasp, const TriangleMesh& mesh, const TriangleBvh& tree,
                const Gripper& gripper) {
    const PlannerConfig config;
    const Eigen::Vector2d pad = pad_half_size_m(gripper);
    const auto cloud = value_of(local_cloud(
        mesh, tree, grasp.X_FG, {pad.x(), pad.y(), 0.5 * grasp.width_m + kPreshapeMargin_m},
        config.local_cloud));
    Points2 local_G;
    for (const Eigen::Vector3d& point : cloud.points_G) local_G.push_back(point.head<2>());
    const auto sides = value_of(grasp_sides(local_G, cloud.line_spacing_m, config.grasp_sides));
    const auto balance =
        value_of(evaluate_force_balance(sides.left_G, sides.right_G, config.force_balance));
    return {{"grasp", json_of_pose(grasp.X_FG)},
            {"width", grasp.width_m},
            {"local", json_of(local_G)},
            {"left", json_of(sides.left_G)},
            {"right", json_of(sides.right_G)},
            {"lean_left", balance.lean_left_rad},
            {"lean_right", balance.lean_right_rad},
            {"beta", balance.beta_rad}};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: paper_stages MESH [CONCAVITY [SHARE]]\n";
        return 2;
    }
    PlannerConfig config;
    if (argc > 3) config.extract_concave_areas.salient_fraction = std::stod(argv[3]);
    const auto profiles = value_of(find_profiles());
    const Gripper gripper = value_of(find_gripper("parallel_85", profiles / "grippers"));
    const auto object = value_of(read_object(argv[1])).object;
    const auto conditioned =
        value_of(condition_mesh(std::get<TriangleMesh>(object), config.condition_mesh));
    const TriangleMesh& mesh = conditioned.mesh;
    const auto measured = value_of(measure_concavity(mesh, {}));
    const auto surface = value_of(sample_surface(mesh, measured.field.value_m,
                                                 gripper.finger_width_m, config.sample_surface));
    const auto areas = value_of(extract_concave_areas(surface.samples, gripper.finger_thickness_m,
                                                      config.extract_concave_areas));
    const auto clusters = value_of(
        cluster_concavities(surface.samples, areas, surface.spacing_m, config.cluster_concavities));
    Json regions = Json::array();
    for (const Concavity& cluster : clusters) {
        regions.push_back({{"depth", cluster.depth_m},
                           {"salient", json_of(points_of(surface, cluster.salient))}});
    }
    const Concavity& chosen = clusters.at(argc > 2 ? std::stoul(argv[2]) : 0U);
    PlanRequest request;
    request.request_id = "concept";
    request.object_O = object;
    request.grippers = {gripper};
    request.options.sources = kBoundary;
    const PlanReply reply = plan(request, {});
    const Json all = {{"mesh", concavity_of(mesh, measured)},
                      {"threshold", areas.threshold_m},
                      {"spacing", surface.spacing_m},
                      {"regions", regions},
                      {"boundary", boundary_of(points_of(surface, chosen.salient),
                                               points_of(surface, chosen.enlarged),
                                               surface.spacing_m, *measured.tree, gripper)},
                      {"balance", balance_of(reply.grasps.at(0), mesh, *measured.tree, gripper)}};
    std::cout << all.dump() << '\n';
    return 0;
}
