#pragma once

#include <filesystem>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/base/moveit_hand.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// Reads the group `moveit` of a gripper's profile: parent_link, parent_xyz [m] and parent_rpy
/// [rad] (that link in the mounting frame H, rotations about the fixed axes x, y, z as in a URDF),
/// and joints, a list of {name, slides, positions: [{opening [m], position}, ...]}; all but the
/// joints' names are optional. A joint without positions is the driver of the profile's `urdf`.
///
/// @param gripper  what load_gripper() made of the same file
/// @return a hand without joints when there is no such group; kInvalidInput naming file, key and
///         value for an unknown key, a wrong type, or openings that do not rise
Result<MoveItHand> load_moveit_hand(const std::filesystem::path& file, const Gripper& gripper);

/// Of every *.yaml of a directory, sorted by the grippers' names.
/// @return as load_grippers() and load_moveit_hand()
Result<std::vector<MoveItHand>> load_moveit_hands(const std::filesystem::path& directory);

}  // namespace graspd
