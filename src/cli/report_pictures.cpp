#include "report_pictures.hpp"

#include <algorithm>
#include <filesystem>

#include "graspd/mesh/principal_frame.hpp"
#include "graspd/simulate/render_views.hpp"
#include "graspd/simulate/write_image.hpp"

namespace graspd::cli {
namespace {

constexpr std::uint32_t kSide = 640;  // [pixel]
constexpr std::array<float, 3> kSalient = {0.85F, 0.13F, 0.16F};
constexpr std::array<float, 3> kAround = {0.95F, 0.71F, 0.20F};

std::vector<double> shares_of(const TracedObject& object) {
    std::vector<double> shares;
    for (const double value_m : object.concavity_m) {
        shares.push_back(object.deepest_m > 0.0 ? value_m / object.deepest_m : 0.0);
    }
    return shares;
}

/// The regions of the best grasp's gripper, surroundings first.
std::vector<PictureDot> region_dots(const TracedSearch& search, const Eigen::Isometry3d& X_FP) {
    std::vector<char> kind(search.surface_P.samples.size());
    for (const Concavity& concavity : search.concavities) {
        for (const std::uint32_t i : concavity.enlarged) kind[i] = std::max<char>(kind[i], 1);
        for (const std::uint32_t i : concavity.salient) kind[i] = 2;
    }
    std::vector<PictureDot> dots;
    for (std::size_t i = 0; i < kind.size(); ++i) {
        if (kind[i] == 0) continue;
        const Eigen::Vector3d point_F = X_FP * search.surface_P.samples[i].point;
        dots.push_back({point_F, kind[i] == 2 ? kSalient : kAround});
    }
    return dots;
}

/// The best grasp's hand; without a grasp an open one before the object, for the camera alone.
void set_hand(const ProcessPlan& plan, const PlanTrace& trace, RestingScene& scene) {
    const auto& grippers = plan.request.grippers;
    scene.gripper = grippers.front();
    scene.width_m = scene.gripper.max_width_m;
    scene.X_FG.translation() = trace.X_FP.translation();
    if (plan.reply.grasps.empty()) return;
    const Grasp& best = plan.reply.grasps.front();
    const auto named = std::ranges::find(grippers, best.gripper_name, &Gripper::name);
    if (named != grippers.end()) scene.gripper = *named;
    scene.width_m = best.width_m;
    scene.X_FG = best.X_FG;
}

}  // namespace

std::optional<PlanError> write_report_pictures(const ProcessPlan& plan, const PlanTrace& trace,
                                               const std::string& directory) {
    if (trace.object.mesh_P.faces.empty()) return std::nullopt;  // refused before
    RestingScene scene;
    scene.mesh_F = transformed(trace.X_FP, trace.object.mesh_P);
    scene.shares = shares_of(trace.object);
    set_hand(plan, trace, scene);
    std::vector<SceneView> views(3);
    std::vector<const char*> names = {"object.png", "concavity.png", "regions.png"};
    views[1].by_share = true;
    if (!trace.searches.empty()) {
        views[2].dots = region_dots(trace.searches.front(), trace.X_FP);
        scene.dot_m = 0.6 * trace.searches.front().surface_P.spacing_m;
    }
    if (!plan.reply.grasps.empty()) {
        views.push_back({true, true, {}});
        names.push_back("grasp.png");
    }
    RenderConfig config;
    config.width = config.height = kSide;
    if (plan.request.support_plane) config.up_F = plan.request.support_plane->normal_F;
    const auto images = render_views(scene, views, config);
    if (!images.ok()) return images.error();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto file = std::filesystem::path(directory) / names[i];
        if (auto error = write_png(images.value()[i], file)) return error;
    }
    return std::nullopt;
}

}  // namespace graspd::cli
