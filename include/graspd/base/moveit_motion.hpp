#pragma once

#include "graspd/base/moveit_hand.hpp"

namespace graspd {

// What the service /plan_grasps and `graspctl export` both say in a moveit_msgs/GripperTranslation.

/// Share of a motion that must be free for a grasp to be tried (min_distance): the whole motion was
/// checked; a robot that cannot go all of it may do with half.
inline constexpr double kMoveItLeastShare = 0.5;

/// The approach direction, unit, in the frame of the hand's parent link.
inline Eigen::Vector3d approach_in_link(const MoveItHand& hand) {
    return hand.X_HP.linear().transpose() * Eigen::Vector3d::UnitZ();
}

}  // namespace graspd
