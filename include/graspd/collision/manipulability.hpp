#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"
#include "graspd/collision/gripper_collision.hpp"

namespace graspd {

/// How the hand comes and how wide it is open meanwhile.
struct ManipulabilityConfig {
    double approach_distance_m = 0.10;    ///< [m] straight along Gz
    double preshape_margin_m = 0.010;     ///< [m] gap beside each pad while it approaches; halved
    std::uint32_t preshape_halvings = 2;  ///< so often, where the wider hand does not fit
    double closing_tolerance_m = 0.0005;  ///< [m] before the contact the closing check ends
    double release_m =
        0.002;  ///< [m] of the retreat that the object has to come off its neighbours

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("approach_distance_m", self.approach_distance_m, 0.0, 1.0);
        visit("preshape_margin_m", self.preshape_margin_m, 1e-4, 0.5);
        visit("preshape_halvings", self.preshape_halvings, 0u, 10u);
        visit("closing_tolerance_m", self.closing_tolerance_m, 1e-5, 0.01);
        visit("release_m", self.release_m, 0.0, 0.1);
    }
};

/// The part of the motion that is not free.
enum class MotionBlock : std::uint8_t { kTooWide, kFinger, kPalm, kApproach, kClosing, kRetreat };

/// Whether the hand can get there.
struct MotionCheck {
    double open_width_m = 0.0;         ///< [m] the pre-shape with which it is free
    std::optional<MotionBlock> block;  ///< none when the whole motion is free
    CollisionPartner partner = CollisionPartner::kObject;  ///< what stands in the way
    double lacking_m = 0.0;  ///< [m] kTooWide: how much the opening is too small

    bool free() const { return !block; }
    /// "too_wide", "finger_hits_object", "approach_hits_plane", ...: the typed reason.
    std::string reason() const;
};

/// Checks approach at the pre-shape opening, the grasp pose, and the closing of the fingers.
///
/// What a part passes is exactly the convex hull of both ends of a straight way, so nothing is
/// sampled: the approach is straight along Gz, closing along Gx. Linkage fingers travel forward
/// while they close: straight from row to row of their table.
///
/// Source: Lei & Wisse 2016, Sec. II-F, Fig. 21.
/// Deviation: the paper compares the hand's length and width with those of the gap.
///
/// @param world            in frame W
/// @param X_WG             grasp frame at the contact
/// @param contact_width_m  [m] pad gap when both pads touch
/// @return the widest pre-shape that is free, else the block of the narrowest one
/// Complexity O(parts log F). Pure, so safe to call from any thread.
MotionCheck check_motion(const CollisionWorld& world, const Gripper& gripper,
                         const Eigen::Isometry3d& X_WG, double contact_width_m,
                         const ManipulabilityConfig& config);

/// Checks fingers and palm at the grasp pose alone: what fails here fails check_motion() too, so a
/// cheap first question.
MotionCheck check_pose(const CollisionWorld& world, const Gripper& gripper,
                       const Eigen::Isometry3d& X_WG, double contact_width_m,
                       const ManipulabilityConfig& config);

/// Checks the way out: the closed hand together with the object that it holds, straight along the
/// support plane's normal, without a plane along -Gz, by approach_distance_m. The hand must meet
/// neither obstacles nor plane nor keep-out boxes, the object no obstacle, once it has come off by
/// release_m: it may lean on what stands beside it. From the plane both only move away.
///
/// @return a block kRetreat ("retreat_hits_obstacle", ...), or none
/// Complexity O(parts log F) and, where obstacles are near the object's way, O(faces there log F).
/// Pure.
MotionCheck check_retreat(const CollisionWorld& world, const Gripper& gripper,
                          const Eigen::Isometry3d& X_WG, double contact_width_m,
                          const ManipulabilityConfig& config);

/// [m] The narrowest gap beside each pad that a pre-shape leaves.
double least_preshape_margin_m(const ManipulabilityConfig& config);

/// The boxes that the hand sweeps from pre-grasp to grasp, in W: palm, left finger, right finger.
std::vector<OrientedBox> swept_approach(const Gripper& gripper, const Eigen::Isometry3d& X_WG,
                                        double contact_width_m, double open_width_m,
                                        double approach_distance_m);

/// How a hand approaches.
struct ApproachShape {
    double contact_width_m = 0.0, open_width_m = 0.0;  ///< [m] pad gaps
    double distance_m = 0.0;                           ///< [m] straight along Gz
};

/// Least distance of the hand from pre-grasp to grasp to anything, and which part comes nearest: of
/// swept_approach(), or of the gripper's convex parts where it has some.
/// @param most_m  [m] > 0: distances beyond it are reported as most_m
Clearance approach_clearance(const CollisionWorld& world, const Gripper& gripper,
                             const Eigen::Isometry3d& X_WG, const ApproachShape& shape,
                             double most_m);

}  // namespace graspd
