#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// Reads one gripper profile: a YAML file with `name` and the dimensions of the JSON member
/// `gripper` (max_width, finger_length, finger_width, finger_thickness, tip_offset, palm_width,
/// palm_height, palm_depth) [m], all required, and optionally min_width [m], palm_z [m],
/// closing_yaw [rad], pad_travel, a list of {opening, pad_z} [m], pad_width and pad_height [m], and
/// convex_parts, a list of {member: palm|finger_left|finger_right, points: [[x, y, z], ...]} [m] in
/// H, the fingers fully open.
///
/// With the key `urdf`, a URDF's path from the profile, the dimensions come from its collision
/// geometry. Required then: name, mount_link (H, whose z axis is the approach), driver_joint (all
/// others mimic it), palm_links, left_links, right_links, left_pad and right_pad {link, point: the
/// middle of the pad's face} [m], pad_width, pad_height [m]; optional open and closed, the driver's
/// positions (default: its lower and upper limit). Which finger is left is free: Gx runs from
/// left_pad to right_pad. The group `moveit` is load_moveit_hand()'s.
///
/// @return kUnreadableFile when it cannot be opened or is not YAML; kInvalidInput naming file, key
///         and value for a missing, unknown or repeated key, a wrong type, or what validate() says
Result<Gripper> load_gripper(const std::filesystem::path& file);

/// Reads every *.yaml of a directory, sorted by the grippers' names.
/// @return kUnreadableFile for a directory that is missing or holds no profile; kInvalidInput when
///         two files carry the same name; else the first file's error
Result<std::vector<Gripper>> load_grippers(const std::filesystem::path& directory);

/// A gripper by its name among a directory's profiles, or by its file when the text ends in .yaml
/// or in .urdf; beside a URDF a profile of the same name with .yaml must lie.
/// @return kUnknownGripper with the names that there are; else as load_gripper, load_grippers
Result<Gripper> find_gripper(const std::string& name_or_file,
                             const std::filesystem::path& directory);

}  // namespace graspd
