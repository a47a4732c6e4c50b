#include "plan_scene.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "close_object.hpp"
#include "graspd/mesh/segment_scene.hpp"

namespace graspd::cli {
namespace {

// An obstacle needs its outline, not its detail.
constexpr std::uint32_t kObstaclePoints = 2000;

Eigen::AlignedBox3d box_of(const PointCloud& cloud) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : cloud.points) box.extend(point);
    return box;
}

/// The closed surfaces of everything that stands on the plane; empty where there is none.
std::vector<TriangleMesh> bodies_of(const SegmentedScene& scene, PlannerConfig config) {
    config.triangulate_cloud.max_points = kObstaclePoints;
    std::vector<TriangleMesh> bodies;
    for (const auto* clouds : {&scene.objects, &scene.background}) {
        for (const PointCloud& cloud : *clouds) {
            std::vector<Finding> ignored;  // of the obstacles
            const auto closed = close_object(cloud, config, ignored);
            bodies.push_back(closed.ok() ? closed.value().solid.mesh : TriangleMesh{});
        }
    }
    return bodies;
}

PlanRequest request_for(const PlanRequest& whole, const SegmentedScene& scene,
                        const std::vector<TriangleMesh>& bodies, std::size_t chosen) {
    PlanRequest request = whole;
    request.object_O = scene.objects[chosen];
    if (!request.support_plane) request.support_plane = SupportPlane{scene.normal, scene.offset_m};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (i == chosen || bodies[i].faces.empty()) continue;
        request.obstacles.push_back({bodies[i], Eigen::Isometry3d::Identity()});
    }
    return request;
}

double best_score(const PlanReply& reply) {
    return reply.grasps.empty() ? -1.0 : reply.grasps.front().score;
}

std::size_t nearest_object(const SegmentedScene& scene, const Eigen::Vector3d& place) {
    const auto nearest = std::ranges::min_element(scene.objects, {}, [&](const PointCloud& cloud) {
        return (box_of(cloud).center() - place).squaredNorm();
    });
    return static_cast<std::size_t>(nearest - scene.objects.begin());
}

}  // namespace

Result<ScenePlan> plan_scene(const PlanRequest& request,
                             const std::optional<Eigen::Vector3d>& object_at_F,
                             const PlannerConfig& config, const StopQuery& stop_requested,
                             PlanTrace* trace) {
    const auto* cloud = std::get_if<PointCloud>(&request.object_O);
    if (cloud == nullptr) {
        return PlanError{PlanErrorCode::kInvalidInput, "--scene needs a cloud, FILE is a mesh"};
    }
    const auto scene = segment_scene(*cloud, config.segment_scene);
    if (!scene.ok()) return scene.error();
    const std::vector<PointCloud>& objects = scene.value().objects;
    const std::vector<TriangleMesh> bodies = bodies_of(scene.value(), config);
    const std::size_t first = object_at_F ? nearest_object(scene.value(), *object_at_F) : 0;
    const std::size_t last = object_at_F ? first + 1 : objects.size();
    std::ostringstream text;
    text << objects.size() << " objects on the plane, " << scene.value().background.size()
         << " larger groups are obstacles;";
    std::optional<ScenePlan> best;
    std::size_t chosen = first;
    for (std::size_t i = first; i < last; ++i) {
        ScenePlan each{request_for(request, scene.value(), bodies, i), {}};
        PlanTrace traced;
        each.reply =
            plan(each.request, config, stop_requested, trace == nullptr ? nullptr : &traced);
        text << " " << i << " at (" << box_of(objects[i]).center().transpose()
             << "): " << to_string(each.reply.status);
        if (!each.reply.grasps.empty()) text << " " << best_score(each.reply);
        text << ";";
        if (best && best_score(each.reply) <= best_score(best->reply)) continue;
        best = std::move(each);
        chosen = i;
        if (trace != nullptr) *trace = std::move(traced);
    }
    text << " this reply is for object " << chosen;
    std::vector<Finding>& findings = best->reply.report.findings;
    findings.insert(findings.begin(),
                    {"scene_objects", static_cast<double>(objects.size()), text.str()});
    return std::move(*best);
}

}  // namespace graspd::cli
