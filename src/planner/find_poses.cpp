#include "find_poses.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace graspd::planner_detail {
namespace {

constexpr const char* kOutside = "outside_approach_cones";

/// The approach cone that a hand's approach misses least.
struct NearestCone {
    double outside_rad = 0.0;     ///< [rad] by how much; not above 0: inside
    double half_angle_rad = 1.0;  ///< [rad] of that cone
};
NearestCone nearest_cone(const Judgement& judgement, const Eigen::Isometry3d& X_PG) {
    const auto& cones = judgement.request.approach_cones;
    if (cones.empty()) return {};
    const Eigen::Vector3d z_F = judgement.X_FP.linear() * X_PG.linear().col(2);
    NearestCone nearest{std::numeric_limits<double>::infinity(), 1.0};
    for (const ApproachCone& cone : cones) {
        const double angle_rad = std::acos(std::clamp(z_F.dot(cone.axis_F), -1.0, 1.0));
        const double outside_rad = angle_rad - cone.half_angle_rad;
        if (outside_rad < nearest.outside_rad) nearest = {outside_rad, cone.half_angle_rad};
    }
    return nearest;
}

/// The middle lines of palm and fingers from the grasp back to where the hand comes from.
class MiddleLines {
public:
    MiddleLines(const Judgement& judgement, double width_m) : tree_P_(*judgement.object.tree_P) {
        const Gripper& gripper = judgement.gripper;
        if (!gripper.convex_parts.empty()) return;  // need not fill their boxes
        const ManipulabilityConfig& config = judgement.config.manipulability;
        const double least_margin_m = least_preshape_margin_m(config);
        for (const GripperPart& part :
             gripper_parts(gripper, width_m, width_m + 2.0 * least_margin_m)) {
            Line line{part.box_G.center(), part.box_G.center(), {}};
            line.front_G.z() = part.box_G.max().z();
            line.rear_G.z() = part.box_G.min().z() - config.approach_distance_m;
            lines_.push_back(line);
        }
    }
    /// @return the typed reason when one is blocked
    const char* blocked(const Eigen::Isometry3d& X_PG) {
        for (Line& line : lines_) {
            if (tree_P_.segment_blocked(X_PG * line.front_G, X_PG * line.rear_G, line.blocker)) {
                return &line == &lines_.front() ? "palm_line_blocked" : "finger_line_blocked";
            }
        }
        return nullptr;
    }

private:
    struct Line {
        Eigen::Vector3d front_G, rear_G;
        TriangleBvh::Blocker blocker;  ///< in the pose before
    };
    const TriangleBvh& tree_P_;
    std::vector<Line> lines_;
};

}  // namespace

double insertion_step_m(const SearchConfig& search, double tip_offset_m) {
    // Of tips so short that little would be left, half.
    const double most_m = std::max(tip_offset_m - search.insertion_least_tip_m, 0.5 * tip_offset_m);
    return std::min(search.insertion_tip_offsets * tip_offset_m, most_m);
}

std::vector<std::uint32_t> spread_turns(std::uint32_t count) {
    std::vector<std::uint32_t> turns;
    const std::uint32_t all = std::bit_ceil(count);
    for (std::uint32_t i = 0; i < all; ++i) {
        std::uint32_t turn = 0;
        for (std::uint32_t bit = 1; bit < all; bit *= 2) turn = 2 * turn + (i / bit) % 2;
        if (turn < count) turns.push_back(turn);
    }
    return turns;
}

std::vector<ApproachPose> find_poses(const ClosingAxis& axis, const Judgement& judgement,
                                     Rejections& rejections) {
    const SearchConfig& search = judgement.config.search;
    const double step_m = insertion_step_m(search, judgement.gripper.tip_offset_m);
    const double width_m = (axis.right_P - axis.left_P).norm();
    MiddleLines lines(judgement, width_m);
    std::vector<ApproachPose> poses;
    for (const std::uint32_t turn : spread_turns(search.approaches)) {
        for (std::uint32_t depth = 0; depth < search.insertions; ++depth) {
            // 0, one deeper, one shallower, two deeper, ...
            const std::uint32_t steps = (depth + 1) / 2;
            const double side = depth % 2 == 1 ? 1.0 : -1.0;
            const ApproachPose pose{2.0 * std::numbers::pi * turn / search.approaches,
                                    side * steps * step_m};
            const Eigen::Isometry3d X_PG = local_frame(axis, pose);
            const NearestCone cone = nearest_cone(judgement, X_PG);
            const char* reason = lines.blocked(X_PG);
            const auto candidate = [&] { return traced(axis, pose, judgement.gripper.name); };
            if (cone.outside_rad > 0.0 && reason == nullptr) {
                rejections.add_miss({X_PG, kOutside, cone.outside_rad, "rad"}, cone.half_angle_rad,
                                    candidate);
            } else if (cone.outside_rad > 0.0) {
                rejections.add(kOutside, candidate);
            } else if (reason != nullptr) {
                rejections.add(reason, candidate);
            } else {
                poses.push_back(pose);
            }
        }
    }
    return poses;
}

}  // namespace graspd::planner_detail
