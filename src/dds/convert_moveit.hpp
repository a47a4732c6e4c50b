#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "convert_basics.hpp"
#include "graspd/dds/dds_settings.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::dds {

// moveit_msgs/srv/GraspPlanning to a planning problem, and an answer back. docs/interface.md,
// section MoveIt, says what each field does.

namespace moveit = ::moveit_msgs::msg::dds_;
using MoveItCall = ::moveit_msgs::srv::dds_::GraspPlanning_Request_;

/// The problem that a call states: target and obstacles with their poses, support surfaces,
/// candidates' poses as hand poses, the gripper that group_name names.
///
/// @param known  the grippers that a call may name
/// @return kInvalidInput naming the first field that is wrong or cannot be served, with its value;
///         kUnknownGripper with the known names
Result<PlanRequest> read_moveit_call(const MoveItCall& call, const std::string& request_id,
                                     std::span<const Gripper> known,
                                     const MoveItSettings& settings);

/// Whether every frame that a call names is the target's: if not, that is why it was refused.
bool has_one_frame(const MoveItCall& call);

/// MoveItErrorCodes, whichever layout they go out in.
struct MoveItVerdict {
    std::int32_t val = 0;  ///< SUCCESS only with grasps
    std::string message;
};

/// What became of a call.
MoveItVerdict moveit_verdict(const PlanReply& reply, const MoveItCall& call);

/// The grasps of a reply, poses those of the end effector's parent link.
/// @param hands  by gripper; one without a hand gives the pose of its mounting frame, no postures
std::vector<moveit::Grasp_> write_moveit_grasps(const PlanReply& reply, const MoveItCall& call,
                                                std::span<const MoveItHand> hands);

}  // namespace graspd::dds
