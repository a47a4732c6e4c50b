#include "graspd/collision/manipulability.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {
namespace {

OrientedBox placed(const Eigen::AlignedBox3d& box_G, const Eigen::Isometry3d& X_WG) {
    OrientedBox box{X_WG, 0.5 * box_G.sizes()};
    box.pose.translation() = X_WG * box_G.center();
    return box;
}

/// A box and everything that it passes on its way along +Gz.
Eigen::AlignedBox3d swept_back(Eigen::AlignedBox3d box_G, double distance_m) {
    box_G.min().z() -= distance_m;
    return box_G;
}

/// The hand at one pre-shape opening, and how far it has to go.
struct Motion {
    const CollisionWorld& world;
    const Gripper& gripper;
    const Eigen::Isometry3d& X_WG;
    double contact_width_m, open_width_m;
    const ManipulabilityConfig& config;

    std::optional<CollisionPartner> hit(const Eigen::AlignedBox3d& box_G) const {
        return find_collision(world, placed(box_G, X_WG));
    }
};

/// Notes a block. @return whether there is one
bool blocked(MotionCheck& check, MotionBlock block, std::optional<CollisionPartner> partner) {
    if (!partner) return false;
    check.block = block;
    check.partner = *partner;
    return true;
}

/// Fingers and palm where they end.
MotionCheck check_end(const Motion& motion, const std::vector<GripperPart>& parts) {
    MotionCheck check;
    check.open_width_m = motion.open_width_m;
    for (const std::size_t part : {1, 2, 0}) {
        const auto block = part == 0 ? MotionBlock::kPalm : MotionBlock::kFinger;
        if (blocked(check, block, motion.hit(parts[part].box_G))) break;
    }
    return check;
}

/// From cheap and likely to dear: where the parts end, then their ways.
MotionCheck check_all(const Motion& motion) {
    const auto parts = gripper_parts(motion.gripper, motion.contact_width_m, motion.open_width_m);
    MotionCheck check = check_end(motion, parts);
    if (!check.free()) return check;
    const auto closed =
        gripper_parts(motion.gripper, motion.contact_width_m,
                      motion.contact_width_m + 2.0 * motion.config.closing_tolerance_m);
    for (const std::size_t finger : {1, 2}) {
        const auto way = parts[finger].box_G.merged(closed[finger].box_G);
        if (blocked(check, MotionBlock::kClosing, motion.hit(way))) return check;
    }
    for (const GripperPart& part : parts) {
        const auto way = swept_back(part.box_G, motion.config.approach_distance_m);
        if (blocked(check, MotionBlock::kApproach, motion.hit(way))) return check;
    }
    return check;
}

/// Whether even the narrowest pre-shape is wider than the gripper opens.
MotionCheck check_width(const Gripper& gripper, double contact_width_m,
                        const ManipulabilityConfig& config) {
    MotionCheck check;
    check.lacking_m = contact_width_m + 2.0 * least_preshape_margin_m(config) - gripper.max_width_m;
    if (check.lacking_m > 0.0) check.block = MotionBlock::kTooWide;
    return check;
}

/// Checks the pre-shapes from the widest to the narrowest until one is free.
template <class Check>
MotionCheck try_preshapes(Motion motion, Check&& check_at) {
    const ManipulabilityConfig& config = motion.config;
    MotionCheck check = check_width(motion.gripper, motion.contact_width_m, config);
    if (!check.free()) return check;
    double margin_m = config.preshape_margin_m;
    for (std::uint32_t i = 0; i <= config.preshape_halvings; ++i, margin_m *= 0.5) {
        const double gap_m = std::max(margin_m, least_preshape_margin_m(config));
        const double open_m =
            std::min(motion.gripper.max_width_m, motion.contact_width_m + 2.0 * gap_m);
        if (open_m == motion.open_width_m) continue;
        motion.open_width_m = open_m;
        check = check_at(motion);
        // A narrower hand stands no better with its palm.
        if (check.free() || check.block == MotionBlock::kPalm) break;
    }
    return check;
}

}  // namespace

std::string MotionCheck::reason() const {
    if (!block) return "free";
    const std::string what = std::string("_hits_") + to_string(partner);
    switch (*block) {
        case MotionBlock::kTooWide: return "too_wide";
        case MotionBlock::kFinger: return "finger" + what;
        case MotionBlock::kPalm: return "palm" + what;
        case MotionBlock::kApproach: return "approach" + what;
        case MotionBlock::kClosing: return "closing" + what;
    }
    return "unknown";
}

double least_preshape_margin_m(const ManipulabilityConfig& config) {
    return std::max(
        std::ldexp(config.preshape_margin_m, -static_cast<int>(config.preshape_halvings)),
        config.closing_tolerance_m);
}

MotionCheck check_pose(const CollisionWorld& world, const Gripper& gripper,
                       const Eigen::Isometry3d& X_WG, double contact_width_m,
                       const ManipulabilityConfig& config) {
    return try_preshapes(
        {world, gripper, X_WG, contact_width_m, 0.0, config}, [](const Motion& motion) {
            return check_end(
                motion, gripper_parts(motion.gripper, motion.contact_width_m, motion.open_width_m));
        });
}

MotionCheck check_motion(const CollisionWorld& world, const Gripper& gripper,
                         const Eigen::Isometry3d& X_WG, double contact_width_m,
                         const ManipulabilityConfig& config) {
    return try_preshapes({world, gripper, X_WG, contact_width_m, 0.0, config}, check_all);
}

std::vector<OrientedBox> swept_approach(const Gripper& gripper, const Eigen::Isometry3d& X_WG,
                                        double contact_width_m, double open_width_m,
                                        double approach_distance_m) {
    std::vector<OrientedBox> boxes;
    for (const GripperPart& part : gripper_parts(gripper, contact_width_m, open_width_m)) {
        boxes.push_back(placed(swept_back(part.box_G, approach_distance_m), X_WG));
    }
    return boxes;
}

}  // namespace graspd
