#include "graspd/planner/draw_plan.hpp"

#include <algorithm>

#include "find_concavities.hpp"
#include "graspd/base/hull_points.hpp"
#include "graspd/mesh/coarsen_mesh.hpp"
#include "graspd/mesh/principal_frame.hpp"
#include "prepare_object.hpp"

namespace graspd {
namespace {

using namespace planner_detail;

std::optional<PlanError> draw_object(const PlanSubject& subject, const PictureLimits& limits,
                                     PlanPicture& picture) {
    const PreparedObject& object = *subject.object;
    auto coarse = coarsen_mesh(object.mesh_P, object.field.value_m, limits.most_faces);
    if (!coarse) return coarse.error();
    picture.object_F = transformed(subject.X_FO * object.X_OP, coarse.value().mesh);
    for (const std::uint32_t vertex : coarse.value().origin) {
        picture.concavity_m.push_back(object.field.value_m[vertex]);
    }
    picture.all_faces = object.mesh_P.faces.size();
    return std::nullopt;
}

std::optional<PlanError> draw_regions(const PlanSubject& subject, const Gripper& gripper,
                                      const PlannerConfig& config, std::uint32_t most_points,
                                      PlanPicture& picture) {
    StageLog log;
    const auto seen = see_surface(*subject.object, gripper, config, false, log);
    if (!seen) return seen.error();
    picture.spacing_m = seen.value().surface.spacing_m;
    picture.deepest_m = std::max(
        subject.object->field.largest_m,
        config.extract_concave_areas.min_depth_finger_thicknesses * gripper.finger_thickness_m);
    std::size_t count = 0;
    for (const Concavity& region : seen.value().concavities) count += region.salient.size();
    const std::size_t stride = (count + most_points - 1) / most_points;
    const Eigen::Isometry3d X_FP = subject.X_FO * subject.object->X_OP;
    for (const Concavity& region : seen.value().concavities) {
        PicturedRegion& drawn = picture.regions.emplace_back();
        drawn.depth_m = region.depth_m;
        for (std::size_t i = 0; i < region.salient.size(); i += stride) {
            drawn.points_F.push_back(X_FP * seen.value().surface.samples[region.salient[i]].point);
        }
    }
    return std::nullopt;
}

std::vector<PicturedPart> boxes_of(const Grasp& grasp, const Gripper& gripper) {
    std::vector<PicturedPart> parts;
    for (const GripperPart& part : gripper_parts(gripper, grasp.width_m, grasp.width_m)) {
        OrientedBox box;
        box.pose = grasp.X_FG * Eigen::Translation3d(part.box_G.center());
        box.half_extent = 0.5 * part.box_G.sizes();
        parts.emplace_back(box);
    }
    return parts;
}

/// The hand as collisions see it, or by its boxes where that takes too many faces.
Result<std::vector<PicturedPart>> draw_hand(const Grasp& grasp, const Gripper& gripper,
                                            std::size_t most_faces) {
    std::vector<PicturedPart> parts;
    std::size_t faces = 0;
    for (const PlacedPart& part : placed_parts(gripper, grasp.width_m, grasp.width_m)) {
        const auto hull = hull_mesh(part.points_G);
        if (!hull) return hull.error();
        faces += hull.value().faces.size();
        parts.emplace_back(transformed(grasp.X_FG, hull.value()));
    }
    if (parts.empty() || faces > most_faces) return boxes_of(grasp, gripper);
    return parts;
}

const Gripper* gripper_of(const Grasp& grasp, const PlanSubject& subject) {
    const auto found = std::ranges::find(subject.grippers, grasp.gripper_name, &Gripper::name);
    return found == subject.grippers.end() ? nullptr : &*found;
}

}  // namespace

Result<PlanPicture> draw_plan(const PlanSubject& subject, std::span<const Grasp> grasps,
                              const PlannerConfig& config, const PictureLimits& limits) {
    PlanPicture picture;
    const std::size_t count = std::min<std::size_t>(grasps.size(), limits.most_grasps);
    for (const Grasp& grasp : grasps.first(count)) {
        const Gripper* gripper = gripper_of(grasp, subject);
        if (gripper == nullptr) {
            return PlanError{PlanErrorCode::kUnknownGripper,
                             "gripper " + grasp.gripper_name + " is not the request's"};
        }
        auto hand = draw_hand(grasp, *gripper, limits.most_faces / count);
        if (!hand) return hand.error();
        picture.hands_F.push_back(std::move(hand).value());
    }
    const Gripper& searched =
        count == 0 ? subject.grippers.front() : *gripper_of(grasps.front(), subject);
    if (const auto bad = draw_regions(subject, searched, config, limits.most_faces, picture)) {
        return *bad;
    }
    if (const auto bad = draw_object(subject, limits, picture)) return *bad;
    return picture;
}

}  // namespace graspd
