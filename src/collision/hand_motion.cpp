#include "hand_motion.hpp"

#include <algorithm>
#include <cmath>

namespace graspd::collision_detail {
namespace {

using Eigen::Vector3d;

constexpr GripperMember kFingers[] = {GripperMember::kFingerLeft, GripperMember::kFingerRight};

const Eigen::AlignedBox3d& box_of(const std::vector<GripperPart>& parts, GripperMember member) {
    return parts[static_cast<std::size_t>(member)].box_G;
}

/// A way along one of the box's axes makes a longer box of it.
std::optional<CollisionPartner> box_hit(const PlacedHand& hand, Eigen::AlignedBox3d box_G,
                                        Vector3d way_G, Against against) {
    if ((way_G.array() != 0.0).count() == 1) {
        const Eigen::AlignedBox3d there = box_G.translated(way_G);
        box_G.extend(there);
        way_G.setZero();
    }
    const OrientedBox box = placed(box_G, hand.X_WG);
    const Vector3d way_W = hand.X_WG.linear() * way_G;
    return against == Against::kAll ? find_collision(hand.world, box, way_W)
                                    : find_obstruction(hand.world, box, way_W);
}

std::optional<CollisionPartner> body_hit(const PlacedHand& hand, const ConvexBody& body,
                                         Against against) {
    return against == Against::kAll ? find_collision(hand.world, body)
                                    : find_obstruction(hand.world, body);
}

/// The openings between which the fingers' boxes move straight, from open to closed.
std::vector<double> straight_steps(const Gripper& gripper, double open_m, double closed_m) {
    std::vector<double> openings = {closed_m};
    for (const PadTravel& row : gripper.pad_travel) {
        if (row.opening_m > closed_m && row.opening_m < open_m) openings.push_back(row.opening_m);
    }
    openings.push_back(open_m);
    std::ranges::reverse(openings);
    return openings;
}

constexpr double kSagitta_m = 1e-4;

/// Openings at steps of the driver so small that no point leaves its chord by more than kSagitta_m.
std::vector<double> turning_steps(const Gripper& gripper, double open_m, double closed_m) {
    const Linkage& linkage = *gripper.linkage;
    double bound = 0.0;
    for (const ConvexPart& part : gripper.convex_parts) {
        double reach_m = 0.0;
        for (const Vector3d& point : part.points) reach_m = std::max(reach_m, point.norm());
        bound = std::max(bound, sagitta_bound(linkage, part.joint, reach_m));
    }
    const double from = driver_position(linkage, open_m), to = driver_position(linkage, closed_m);
    const double count =
        std::max(1.0, std::ceil(std::abs(to - from) * std::sqrt(bound / kSagitta_m)));
    std::vector<double> openings = {open_m};
    for (double i = 1.0; i < count; i += 1.0) {
        openings.push_back(pad_gap_m(linkage, from + (to - from) * i / count));
    }
    openings.push_back(closed_m);
    return openings;
}

std::optional<CollisionPartner> boxes_closing_hit(const PlacedHand& hand, double open_m,
                                                  double closed_m) {
    const auto steps = straight_steps(hand.gripper, open_m, closed_m);
    auto parts = gripper_parts(hand.gripper, hand.contact_width_m, steps.front());
    for (std::size_t step = 1; step < steps.size(); ++step) {
        auto next = gripper_parts(hand.gripper, hand.contact_width_m, steps[step]);
        for (const GripperMember finger : kFingers) {
            const Vector3d way_G = box_of(next, finger).center() - box_of(parts, finger).center();
            const auto partner = box_hit(hand, box_of(parts, finger), way_G, Against::kAll);
            if (partner) return partner;
        }
        parts = std::move(next);
    }
    return std::nullopt;
}

}  // namespace

OrientedBox placed(const Eigen::AlignedBox3d& box_G, const Eigen::Isometry3d& X_WG) {
    OrientedBox box{X_WG, 0.5 * box_G.sizes()};
    box.pose.translation() = X_WG * box_G.center();
    return box;
}

std::vector<ConvexBody> placed_bodies(const PlacedHand& hand, double opening_m,
                                      std::optional<GripperMember> member) {
    std::vector<ConvexBody> bodies;
    for (PlacedPart& part : placed_parts(hand.gripper, hand.contact_width_m, opening_m)) {
        if (member && part.member != *member) continue;
        for (Vector3d& point : part.points_G) point = hand.X_WG * point;
        bodies.push_back({std::move(part.points_G), hand.X_WG.linear()});
    }
    return bodies;
}

std::optional<CollisionPartner> member_hit(const PlacedHand& hand, GripperMember member,
                                           double opening_m, const Vector3d& way_G,
                                           Against against) {
    if (hand.gripper.convex_parts.empty()) {
        const auto parts = gripper_parts(hand.gripper, hand.contact_width_m, opening_m);
        return box_hit(hand, box_of(parts, member).translated(-way_G), way_G, against);
    }
    const Vector3d back_W = -(hand.X_WG.linear() * way_G);
    for (ConvexBody& body : placed_bodies(hand, opening_m, member)) {
        if (!back_W.isZero(0.0)) body = swept(std::move(body), back_W);
        if (const auto partner = body_hit(hand, body, against)) return partner;
    }
    return std::nullopt;
}

std::optional<CollisionPartner> closing_hit(const PlacedHand& hand, double open_m,
                                            double closed_m) {
    const Gripper& gripper = hand.gripper;
    if (gripper.convex_parts.empty()) return boxes_closing_hit(hand, open_m, closed_m);
    const auto steps = gripper.linkage ? turning_steps(gripper, open_m, closed_m)
                                       : straight_steps(gripper, open_m, closed_m);
    for (const GripperMember finger : kFingers) {
        auto bodies = placed_bodies(hand, steps.front(), finger);
        for (std::size_t step = 1; step < steps.size(); ++step) {
            auto next = placed_bodies(hand, steps[step], finger);
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                ConvexBody way = std::move(bodies[i]);
                way.points_W.insert(way.points_W.end(), next[i].points_W.begin(),
                                    next[i].points_W.end());
                if (gripper.linkage) way = grown(way, kSagitta_m);
                if (const auto partner = body_hit(hand, way, Against::kAll)) return partner;
            }
            bodies = std::move(next);
        }
    }
    return std::nullopt;
}

}  // namespace graspd::collision_detail
