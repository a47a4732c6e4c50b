#include "order_axes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "graspd/base/parallel.hpp"

namespace graspd::planner_detail {
namespace {

// Where a line touches an edge from both sides; less apart, the places no longer tell the
// direction.
constexpr double kLeastWidth_m = 1e-6;
constexpr double kSameBadness_rad = 1e-7;  // less is rounding: then the order of axes decides

constexpr const char* kTooWide = "axis_too_wide";

struct Touch {
    Eigen::Vector3d point_P, normal_P;
};

struct ProbedAxis {
    ClosingAxis axis;
    double badness_rad = 0.0;  ///< lean, and the lever in units of lever_weight
};

/// What a finger that comes from `margin_m` before `place` meets, up to `reach_m` further on.
std::optional<Touch> touch(const PreparedObject& object, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& direction, double margin_m, double reach_m) {
    const auto hit =
        object.tree_P->first_hit(place - margin_m * direction, direction, margin_m + reach_m);
    if (!hit || !hit->from_outside) return std::nullopt;
    return Touch{place + (hit->distance_m - margin_m) * direction,
                 face_normal(object.mesh_P, hit->face)};
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

/// Arm of the torque about a closing line: the mean of gravity's, which is none where the centre of
/// mass hangs straight below or stands above the line, and shaking's, which has any direction;
/// where gravity's direction is not known, that of shaking.
double lever_m(const Judgement& judgement, const Eigen::Vector3d& place,
               const Eigen::Vector3d& closing) {
    const Eigen::Vector3d arm = judgement.center_of_mass_P - place;
    const double shaken_m = arm.cross(closing).norm();
    if (!judgement.down_P) return shaken_m;
    return 0.5 * (std::abs(arm.cross(*judgement.down_P).dot(closing)) + shaken_m);
}

/// Closes along the axis's line alone. @return the typed reason when it is no grasp
const char* probe(ProbedAxis& probed, const Judgement& judgement) {
    ClosingAxis& axis = probed.axis;
    const PlannerConfig& config = judgement.config;
    const double length_m = (axis.right_P - axis.left_P).norm();
    const Eigen::Vector3d closing = (axis.right_P - axis.left_P) / length_m;
    const auto left =
        widest_touch(judgement.object, axis.left_P, closing, length_m, config.manipulability);
    const auto right =
        widest_touch(judgement.object, axis.right_P, -closing, length_m, config.manipulability);
    if (!left || !right) return "axis_no_contact";
    const double width_m = closing.dot(right->point_P - left->point_P);
    if (width_m <= std::max(judgement.gripper.min_width_m, kLeastWidth_m)) {
        return "axis_no_contact";
    }
    const double lean_rad = std::max(angle_between_rad(closing, -left->normal_P),
                                     angle_between_rad(closing, right->normal_P));
    if (lean_rad > config.opposite_candidates.max_lean_rad) return "axis_leans";
    axis.left_P = left->point_P;
    axis.right_P = right->point_P;
    if (width_m >= judgement.gripper.max_width_m) return kTooWide;
    probed.badness_rad =
        lean_rad + config.search.lever_weight_rad_m * lever_m(judgement, axis.left_P, closing);
    return nullptr;
}

/// Counts an axis that fell; one that is too wide misses by what the opening lacks.
void count(const ClosingAxis& axis, const char* reason, const Judgement& judgement,
           Rejections& rejections) {
    const auto candidate = [&] { return traced(axis, {}, judgement.gripper.name); };
    if (reason != kTooWide) return rejections.add(reason, candidate);
    const double opening_m = judgement.gripper.max_width_m;
    const double margin_m = least_preshape_margin_m(judgement.config.manipulability);
    const double needed_m = (axis.right_P - axis.left_P).norm() + 2.0 * margin_m;
    rejections.add_miss({local_frame(axis, {}), reason, needed_m - opening_m, "m"}, opening_m,
                        candidate);
}

}  // namespace

bool similar(const ClosingAxis& a, const ClosingAxis& b, const Judgement& judgement) {
    const RankGraspsConfig& same = judgement.config.rank_grasps;
    const double near_m = same.same_distance_finger_widths * judgement.gripper.finger_width_m;
    const Eigen::Vector3d middle_a = 0.5 * (a.left_P + a.right_P);
    const Eigen::Vector3d middle_b = 0.5 * (b.left_P + b.right_P);
    if ((middle_a - middle_b).norm() > near_m) return false;
    const double angle = angle_between_rad(a.right_P - a.left_P, b.right_P - b.left_P);
    return std::min(angle, std::numbers::pi - angle) <= same.same_angle_rad;
}

std::vector<ClosingAxis> order_axes(std::vector<ClosingAxis> axes, const Judgement& judgement,
                                    Rejections& rejections) {
    constexpr std::size_t kAtATime = 32;
    std::vector<ProbedAxis> candidates;
    for (ClosingAxis& axis : axes) candidates.push_back({std::move(axis), 0.0});
    std::vector<const char*> reasons(candidates.size());
    for_blocks(candidates.size(), kAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) reasons[i] = probe(candidates[i], judgement);
    });
    std::vector<ProbedAxis> probed;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (reasons[i]) {
            count(candidates[i].axis, reasons[i], judgement, rejections);
        } else {
            probed.push_back(std::move(candidates[i]));
        }
    }
    std::ranges::stable_sort(probed, {}, [](const ProbedAxis& candidate) {
        return std::floor(candidate.badness_rad / kSameBadness_rad + 0.5);
    });
    std::vector<ClosingAxis> ordered;
    for (ProbedAxis& candidate : probed) ordered.push_back(std::move(candidate.axis));
    return ordered;
}

}  // namespace graspd::planner_detail
