#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/base/moveit_hand.hpp"
#include "graspd/base/result.hpp"
#include "read_grasps.hpp"

namespace graspd::cli {

/// A gripper with what its profile tells other tools: a link's pose, joints.
struct ExportHand {
    Gripper gripper;
    MoveItHand moveit;  ///< without joints when the profile has no group `moveit`
};

/// A profile by its name, or by its file (.yaml, .urdf).
/// @return as find_gripper() and load_moveit_hand()
Result<ExportHand> find_hand(const std::string& name_or_file,
                             const std::filesystem::path& grippers);

/// The profiles of all grippers that the grasps name.
/// @return kUnknownGripper, naming the grasp, for a name that is no profile's
Result<std::vector<ExportHand>> find_hands(const GraspFile& file,
                                           const std::filesystem::path& grippers);

/// The hand that a grasp is for.
/// @return kUnknownGripper with the grasp's index, its gripper and those that there are
Result<ExportHand> hand_of(const GraspFile& file, std::size_t index,
                           std::span<const ExportHand> hands);

/// Whether all grasps are for one gripper. @return else kInvalidInput naming two, and the format
std::optional<PlanError> check_one_gripper(const GraspFile& file, const std::string& format);

}  // namespace graspd::cli
