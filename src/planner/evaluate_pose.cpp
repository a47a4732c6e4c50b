#include "evaluate_pose.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace graspd::planner_detail {
namespace {

constexpr const char* kManipulability = "collision/manipulability";

/// One pose under examination; each step returns false after it has counted the reason.
class Examination {
public:
    Examination(const ClosingAxis& axis, const Judgement& judgement, Rejections& rejections,
                StageLog& log)
        : judgement_(judgement), rejections_(rejections), log_(log) {
        grasp_.axis = axis;
        grasp_.gripper = &judgement.gripper;
        grasp_.width_m = (axis.right_P - axis.left_P).norm();
    }

    bool reach();
    bool close();
    bool move();
    bool retreat();
    bool balance();
    bool press();
    void grade();

    GradedGrasp grasp_;

private:
    bool reject(const char* reason) {
        rejections_.add(reason, [&] { return candidate(); });
        return false;
    }
    bool miss(const std::string& reason, double margin, const char* unit, double scale) {
        rejections_.add_miss({grasp_.X_PG, reason, margin, unit}, scale,
                             [&] { return candidate(); });
        return false;
    }
    TracedCandidate candidate() const;
    bool judge(const MotionCheck& check);
    Result<LocalCloud> close_from_widest() const;

    const Judgement& judgement_;
    Rejections& rejections_;
    StageLog& log_;
    LocalCloud cloud_;
    bool balanced_ = false;  ///< whether the evidence holds the balance yet
};

TracedCandidate Examination::candidate() const {
    TracedCandidate so_far = traced(grasp_);
    so_far.score = TracedCandidate::kUnknown;
    if (!balanced_) so_far.beta_rad = so_far.min_friction = TracedCandidate::kUnknown;
    return so_far;
}

bool Examination::judge(const MotionCheck& check) {
    if (check.free()) return true;
    if (check.block == MotionBlock::kTooWide) {
        return miss(check.reason(), check.lacking_m, "m", judgement_.gripper.max_width_m);
    }
    return reject(check.reason().c_str());
}

/// Whether the hand can stand there at all.
bool Examination::reach() {
    return judge(log_.run(kManipulability, 1, [&] {
        return check_pose(judgement_.world_P, judgement_.gripper, grasp_.X_PG, grasp_.width_m,
                          judgement_.config.manipulability);
    }));
}

/// Closes from the widest pre-shape whose pads begin outside the object.
Result<LocalCloud> Examination::close_from_widest() const {
    const Gripper& gripper = judgement_.gripper;
    const ManipulabilityConfig& config = judgement_.config.manipulability;
    const Eigen::Vector2d pad = pad_half_size_m(gripper);
    PadFootprint footprint{pad.x(), pad.y(), 0.0};
    double margin_m = config.preshape_margin_m;
    for (std::uint32_t i = 0;; ++i, margin_m *= 0.5) {
        footprint.half_reach_m = 0.5 * grasp_.width_m + margin_m;
        auto cloud = local_cloud(judgement_.object.mesh_P, *judgement_.object.tree_P, grasp_.X_PG,
                                 footprint, judgement_.config.local_cloud);
        if (cloud.ok() || i == config.preshape_halvings) return cloud;
    }
}

/// The fingers close: where the pads touch, how wide apart, and the hand in the middle of that.
bool Examination::close() {
    const auto cloud = log_.run("grasp/local_cloud", 1, [&] { return close_from_widest(); });
    if (!cloud) return reject("no_contact");
    cloud_ = cloud.value();
    grasp_.width_m = cloud_.right.x_G - cloud_.left.x_G;
    if (grasp_.width_m <= judgement_.gripper.min_width_m) return reject("too_thin");
    log_.out("grasp/local_cloud", 1);
    const double shift_m = 0.5 * (cloud_.left.x_G + cloud_.right.x_G);
    grasp_.X_PG.translation() += shift_m * grasp_.X_PG.linear().col(0);
    for (Eigen::Vector3d& point : cloud_.points_G) point.x() -= shift_m;
    for (PadTouch* touch : {&cloud_.left, &cloud_.right}) {
        touch->x_G -= shift_m;
        touch->point_G.x() -= shift_m;
    }
    return true;
}

/// Whether the whole motion to where the pads touch is free.
bool Examination::move() {
    const MotionCheck check = log_.run(kManipulability, 1, [&] {
        return check_motion(judgement_.world_P, judgement_.gripper, grasp_.X_PG, grasp_.width_m,
                            judgement_.config.manipulability);
    });
    if (!judge(check)) return false;
    grasp_.open_width_m = check.open_width_m;
    return true;
}

/// Whether the hand gets away with the object.
bool Examination::retreat() {
    const bool free = judge(log_.run(kManipulability, 0, [&] {
        return check_retreat(judgement_.world_P, judgement_.gripper, grasp_.X_PG, grasp_.width_m,
                             judgement_.config.manipulability);
    }));
    log_.out(kManipulability, free ? 1 : 0);
    return free;
}

/// Section II-F: the two sides, the angle between their lines, and the friction they need.
bool Examination::balance() {
    std::vector<Eigen::Vector2d> flat;
    flat.reserve(cloud_.points_G.size());
    for (const Eigen::Vector3d& point : cloud_.points_G) flat.push_back(point.head<2>());
    const auto sides = log_.run("grasp/grasp_sides", flat.size(), [&] {
        return grasp_sides(flat, cloud_.line_spacing_m, judgement_.config.grasp_sides);
    });
    if (!sides) return reject("contact_too_small");
    const auto balance = log_.run("grasp/force_balance", 1, [&] {
        return evaluate_force_balance(sides.value().left_G, sides.value().right_G,
                                      judgement_.config.force_balance);
    });
    if (!balance) return reject("side_not_straight");
    GraspEvidence& evidence = grasp_.evidence;
    evidence.beta_rad = balance.value().beta_rad;
    evidence.friction = judgement_.request.options.friction;
    evidence.min_friction = min_friction(cloud_.left.point_G, cloud_.left.normal_G,
                                         cloud_.right.point_G, cloud_.right.normal_G);
    balanced_ = true;
    if (evidence.min_friction <= evidence.friction) {
        log_.out("grasp/force_balance", 1);
        return true;
    }
    const double lacking = evidence.min_friction - evidence.friction;
    if (!std::isfinite(lacking)) return reject("slips");  // no friction holds it: not a near miss
    return miss("slips", lacking, "1", evidence.friction);
}

/// Presses the fingers' whole faces on the object and compares the load with what they carry.
bool Examination::press() {
    const Gripper& gripper = judgement_.gripper;
    const FingerFace face{0.5 * gripper.finger_width_m,
                          gripper.tip_offset_m - gripper.finger_length_m, gripper.tip_offset_m,
                          0.5 * grasp_.open_width_m};
    constexpr const char* kPatch = "grasp/contact_patch";
    const auto patches = log_.run(kPatch, 1, [&] {
        return contact_patches(*judgement_.object.tree_P, grasp_.X_PG, face,
                               judgement_.config.contact_patch);
    });
    if (!patches) return reject("no_contact");
    log_.out(kPatch, 1);
    GraspEvidence& evidence = grasp_.evidence;
    const Eigen::Isometry3d X_GP = grasp_.X_PG.inverse();
    std::optional<Eigen::Vector3d> down_G = judgement_.down_P;
    if (down_G) down_G = X_GP.linear() * *judgement_.down_P;
    const HeldLoad load{X_GP * judgement_.center_of_mass_P,
                        down_G,
                        judgement_.mass_kg,
                        judgement_.request.options.grip_force_N,
                        evidence.friction,
                        evidence.min_friction};
    evidence.opening_left = 1.0 - grasp_.width_m / gripper.max_width_m;
    evidence.mass_kg = load.mass_kg;
    evidence.loads = load_ratios(patches.value(), load, judgement_.config.load_ratios);
    evidence.contact_share = std::min(patches.value().left.share, patches.value().right.share);
    return true;
}

void Examination::grade() {
    grasp_.score = score_grasp(grasp_.evidence, judgement_.config.score_grasp);
    const PadTouch* touches[] = {&cloud_.left, &cloud_.right};
    for (std::size_t i = 0; i < 2; ++i) {
        grasp_.contacts_P[i] = {grasp_.X_PG * touches[i]->point_G,
                                grasp_.X_PG.linear() * touches[i]->normal_G};
    }
}

}  // namespace

TracedCandidate traced(const GradedGrasp& grasp) {
    TracedCandidate candidate;
    candidate.X_PG = grasp.X_PG;
    candidate.width_m = grasp.width_m;
    candidate.gripper_name = grasp.gripper->name;
    candidate.source = grasp.axis.source;
    candidate.concavity = grasp.axis.concavity;
    candidate.beta_rad = grasp.evidence.beta_rad;
    candidate.min_friction = grasp.evidence.min_friction;
    candidate.score = grasp.score.score;
    return candidate;
}

std::optional<GradedGrasp> evaluate_pose(const ClosingAxis& axis, const ApproachPose& approach,
                                         const Judgement& judgement, Rejections& rejections,
                                         StageLog& log) {
    Examination pose(axis, judgement, rejections, log);
    pose.grasp_.X_PG = local_frame(axis, approach);
    if (!pose.reach() || !pose.close() || !pose.balance() || !pose.move() || !pose.retreat() ||
        !pose.press()) {
        return std::nullopt;
    }
    pose.grade();
    return pose.grasp_;
}

std::optional<GradedGrasp> evaluate_beside(const Eigen::Isometry3d& X_PG, double width_m,
                                           const Judgement& judgement) {
    Rejections unused;
    StageLog untold;
    return evaluate_pose(axis_through(X_PG, width_m), {}, judgement, unused, untold);
}

}  // namespace graspd::planner_detail
