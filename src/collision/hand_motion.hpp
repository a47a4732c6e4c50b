#pragma once

#include <optional>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/collision/convex_collision.hpp"

namespace graspd::collision_detail {

/// A hand at a grasp in a world; its parts are boxes or, where it has some, convex parts.
struct PlacedHand {
    const CollisionWorld& world;
    const Gripper& gripper;
    const Eigen::Isometry3d& X_WG;
    double contact_width_m = 0.0;
};

enum class Against : std::uint8_t { kAll, kAllButTheObject };

/// What one member meets at an opening, with all that it passes when it comes along a way that ends
/// where it stands.
/// @param way_G  [m]
std::optional<CollisionPartner> member_hit(const PlacedHand& hand, GripperMember member,
                                           double opening_m, const Eigen::Vector3d& way_G,
                                           Against against = Against::kAll);

/// What the fingers meet on their way from one opening to a narrower one. Straight pieces of the
/// pads' travel are exact; turning links are held by hulls of steps of the driver, which are grown
/// by the most that a point leaves its chord: 0.1 mm.
std::optional<CollisionPartner> closing_hit(const PlacedHand& hand, double open_m, double closed_m);

/// A box of G in W.
OrientedBox placed(const Eigen::AlignedBox3d& box_G, const Eigen::Isometry3d& X_WG);

/// The convex parts in W; none when the gripper is made of boxes.
std::vector<ConvexBody> placed_bodies(const PlacedHand& hand, double opening_m,
                                      std::optional<GripperMember> member = std::nullopt);

}  // namespace graspd::collision_detail
