#include "choose_axes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace graspd::planner_detail {
namespace {

struct Touch {
    Eigen::Vector3d point_P, normal_P;
};

struct ProbedAxis {
    ClosingAxis axis;
    double badness_rad = 0.0;  ///< lean, and the lever in units of lever_weight
};

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// What a finger that comes from `margin_m` before `place` meets, up to `reach_m` further on.
std::optional<Touch> touch(const PreparedObject& object, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& direction, double margin_m, double reach_m) {
    const auto hit =
        object.tree_P->first_hit(place - margin_m * direction, direction, margin_m + reach_m);
    if (!hit || !hit->from_outside) return std::nullopt;
    const Triangle& t = object.mesh_P.faces[hit->face];
    const auto& v = object.mesh_P.vertices;
    const Eigen::Vector3d normal = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).stableNormalized();
    return Touch{place + (hit->distance_m - margin_m) * direction, normal};
}

/// The touch of a finger with the widest margin that begins outside the object.
std::optional<Touch> widest_touch(const PreparedObject& object, const Eigen::Vector3d& place,
                                  const Eigen::Vector3d& direction, double reach_m,
                                  const ManipulabilityConfig& config) {
    double margin_m = config.preshape_margin_m;
    for (std::uint32_t i = 0; i <= config.preshape_halvings; ++i, margin_m *= 0.5) {
        if (auto met = touch(object, place, direction, margin_m, reach_m)) return met;
    }
    return std::nullopt;
}

/// Closes along the axis's line alone. @return the typed reason when it is no grasp
const char* probe(ProbedAxis& probed, const PreparedObject& object,
                  const Eigen::Vector3d& center_of_mass_P, const Gripper& gripper,
                  const PlannerConfig& config) {
    ClosingAxis& axis = probed.axis;
    const double length_m = (axis.right_P - axis.left_P).norm();
    const Eigen::Vector3d closing = (axis.right_P - axis.left_P) / length_m;
    const auto left = widest_touch(object, axis.left_P, closing, length_m, config.manipulability);
    const auto right =
        widest_touch(object, axis.right_P, -closing, length_m, config.manipulability);
    if (!left || !right) return "axis_no_contact";
    const double width_m = closing.dot(right->point_P - left->point_P);
    if (width_m <= gripper.min_width_m) return "axis_no_contact";
    if (width_m >= gripper.max_width_m) return "axis_too_wide";
    const double lean_rad =
        std::max(angle_between(closing, -left->normal_P), angle_between(closing, right->normal_P));
    if (lean_rad > config.opposite_candidates.max_lean_rad) return "axis_leans";
    axis.left_P = left->point_P;
    axis.right_P = right->point_P;
    const double lever_m = (center_of_mass_P - axis.left_P).cross(closing).norm();
    probed.badness_rad = lean_rad + config.search.lever_weight_rad_m * lever_m;
    return nullptr;
}

bool similar(const ClosingAxis& a, const ClosingAxis& b, double near_m, double angle_rad) {
    const Eigen::Vector3d middle_a = 0.5 * (a.left_P + a.right_P);
    const Eigen::Vector3d middle_b = 0.5 * (b.left_P + b.right_P);
    if ((middle_a - middle_b).norm() > near_m) return false;
    const double angle = angle_between(a.right_P - a.left_P, b.right_P - b.left_P);
    return std::min(angle, M_PI - angle) <= angle_rad;
}

}  // namespace

std::vector<ClosingAxis> choose_axes(std::vector<ClosingAxis> axes, std::uint32_t most,
                                     const PreparedObject& object,
                                     const Eigen::Vector3d& center_of_mass_P,
                                     const Gripper& gripper, const PlannerConfig& config,
                                     Rejections& rejections) {
    std::vector<ProbedAxis> probed;
    for (ClosingAxis& axis : axes) {
        ProbedAxis candidate{std::move(axis), 0.0};
        const char* reason = probe(candidate, object, center_of_mass_P, gripper, config);
        if (reason != nullptr) {
            rejections.add(reason);
        } else {
            probed.push_back(std::move(candidate));
        }
    }
    std::ranges::stable_sort(probed, {}, &ProbedAxis::badness_rad);
    const double near_m = config.rank_grasps.same_distance_finger_widths * gripper.finger_width_m;
    std::vector<ClosingAxis> chosen;
    for (const ProbedAxis& candidate : probed) {
        const bool known = std::ranges::any_of(chosen, [&](const ClosingAxis& better) {
            return similar(candidate.axis, better, near_m, config.rank_grasps.same_angle_rad);
        });
        if (known) {
            rejections.add("axis_similar");
        } else if (chosen.size() == most) {
            rejections.add("axis_surplus");
        } else {
            chosen.push_back(candidate.axis);
        }
    }
    return chosen;
}

}  // namespace graspd::planner_detail
