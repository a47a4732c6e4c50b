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
/// closing_yaw [rad] and pad_travel, a list of {opening, pad_z} [m].
///
/// @return kUnreadableFile when it cannot be opened or is not YAML; kInvalidInput naming file, key
///         and value for a missing, unknown or repeated key, a wrong type, or what validate() says
Result<Gripper> load_gripper(const std::filesystem::path& file);

/// Reads every *.yaml of a directory, sorted by the grippers' names.
/// @return kUnreadableFile for a directory that is missing or holds no profile; kInvalidInput when
///         two files carry the same name; else the first file's error
Result<std::vector<Gripper>> load_grippers(const std::filesystem::path& directory);

/// A gripper by its name among a directory's profiles, or by its file when the text ends in .yaml.
/// @return kUnknownGripper with the names that there are; else as load_gripper, load_grippers
Result<Gripper> find_gripper(const std::string& name_or_file,
                             const std::filesystem::path& directory);

}  // namespace graspd
