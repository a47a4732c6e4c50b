#include "graspd/collision/manipulability.hpp"

#include <algorithm>
#include <cmath>

#include "hand_motion.hpp"
#include "swept_body.hpp"

namespace graspd {
namespace {

using collision_detail::Against;
using collision_detail::PlacedHand;

constexpr GripperMember kPalm = GripperMember::kPalm;
// From likely to unlikely.
constexpr GripperMember kMembers[] = {GripperMember::kFingerLeft, GripperMember::kFingerRight,
                                      kPalm};

/// The hand at one pre-shape opening, and how far it has to go.
struct Motion {
    PlacedHand hand;
    double open_width_m = 0.0;
    const ManipulabilityConfig& config;

    std::optional<CollisionPartner> hit(GripperMember member, double way_m) const {
        return member_hit(hand, member, open_width_m, way_m * Eigen::Vector3d::UnitZ());
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
MotionCheck check_end(const Motion& motion) {
    MotionCheck check;
    check.open_width_m = motion.open_width_m;
    for (const GripperMember member : kMembers) {
        const auto block = member == kPalm ? MotionBlock::kPalm : MotionBlock::kFinger;
        if (blocked(check, block, motion.hit(member, 0.0))) break;
    }
    return check;
}

/// From cheap and likely to dear: where the parts end, then their ways.
MotionCheck check_all(const Motion& motion) {
    MotionCheck check = check_end(motion);
    if (!check.free()) return check;
    const double closed_m = motion.hand.contact_width_m + 2.0 * motion.config.closing_tolerance_m;
    const auto closing = closing_hit(motion.hand, motion.open_width_m, closed_m);
    if (blocked(check, MotionBlock::kClosing, closing)) return check;
    for (const GripperMember member : {kPalm, kMembers[0], kMembers[1]}) {
        const auto partner = motion.hit(member, motion.config.approach_distance_m);
        if (blocked(check, MotionBlock::kApproach, partner)) return check;
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
    const double contact_m = motion.hand.contact_width_m;
    MotionCheck check = check_width(motion.hand.gripper, contact_m, config);
    if (!check.free()) return check;
    double margin_m = config.preshape_margin_m;
    for (std::uint32_t i = 0; i <= config.preshape_halvings; ++i, margin_m *= 0.5) {
        const double gap_m = std::max(margin_m, least_preshape_margin_m(config));
        const double open_m = std::min(motion.hand.gripper.max_width_m, contact_m + 2.0 * gap_m);
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
        case MotionBlock::kRetreat: return "retreat" + what;
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
    return try_preshapes({{world, gripper, X_WG, contact_width_m}, 0.0, config}, check_end);
}

MotionCheck check_motion(const CollisionWorld& world, const Gripper& gripper,
                         const Eigen::Isometry3d& X_WG, double contact_width_m,
                         const ManipulabilityConfig& config) {
    return try_preshapes({{world, gripper, X_WG, contact_width_m}, 0.0, config}, check_all);
}

MotionCheck check_retreat(const CollisionWorld& world, const Gripper& gripper,
                          const Eigen::Isometry3d& X_WG, double contact_width_m,
                          const ManipulabilityConfig& config) {
    MotionCheck check;
    const Eigen::Vector3d direction =
        world.plane ? world.plane->normal : Eigen::Vector3d(-X_WG.linear().col(2));
    const double distance_m = config.approach_distance_m;
    const PlacedHand hand{world, gripper, X_WG, contact_width_m};
    const Eigen::Vector3d back_G = -distance_m * (X_WG.linear().transpose() * direction);
    for (const GripperMember member : kMembers) {
        const auto partner =
            member_hit(hand, member, contact_width_m, back_G, Against::kAllButTheObject);
        if (blocked(check, MotionBlock::kRetreat, partner)) return check;
    }
    if (config.release_m >= distance_m) return check;
    const Eigen::Vector3d released = config.release_m * direction;
    const Eigen::Vector3d way = distance_m * direction - released;
    for (const CollisionBody& obstacle : world.obstacles) {
        if (!collision_detail::sweep_meets(world.object, released, way, obstacle)) continue;
        blocked(check, MotionBlock::kRetreat, CollisionPartner::kObstacle);
        break;
    }
    return check;
}

std::vector<OrientedBox> swept_approach(const Gripper& gripper, const Eigen::Isometry3d& X_WG,
                                        double contact_width_m, double open_width_m,
                                        double approach_distance_m) {
    std::vector<OrientedBox> boxes;
    for (const GripperPart& part : gripper_parts(gripper, contact_width_m, open_width_m)) {
        Eigen::AlignedBox3d box_G = part.box_G;
        box_G.min().z() -= approach_distance_m;
        boxes.push_back(collision_detail::placed(box_G, X_WG));
    }
    return boxes;
}

Clearance approach_clearance(const CollisionWorld& world, const Gripper& gripper,
                             const Eigen::Isometry3d& X_WG, const ApproachShape& shape,
                             double most_m) {
    if (gripper.convex_parts.empty()) {
        return find_clearance(world,
                              swept_approach(gripper, X_WG, shape.contact_width_m,
                                             shape.open_width_m, shape.distance_m),
                              most_m);
    }
    const Eigen::Vector3d back_W = -shape.distance_m * X_WG.linear().col(2);
    auto bodies = collision_detail::placed_bodies({world, gripper, X_WG, shape.contact_width_m},
                                                  shape.open_width_m);
    for (ConvexBody& body : bodies) body = swept(std::move(body), back_W);
    return find_clearance(world, bodies, most_m);
}

}  // namespace graspd
