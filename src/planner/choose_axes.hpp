#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/planner/planner_config.hpp"
#include "prepare_object.hpp"
#include "rejections.hpp"

namespace graspd::planner_detail {

/// Chooses the closing axes that are followed up: those on which a single line sees two touches
/// that lean little from it and lie near the centre of mass, and that are not alike.
///
/// Each axis that falls is counted: axis_no_contact, axis_leans, axis_too_wide, axis_similar,
/// axis_surplus. What remains has its two places moved to where the line touches.
/// @param most  how many are kept at most
std::vector<ClosingAxis> choose_axes(std::vector<ClosingAxis> axes, std::uint32_t most,
                                     const PreparedObject& object,
                                     const Eigen::Vector3d& center_of_mass_P,
                                     const Gripper& gripper, const PlannerConfig& config,
                                     Rejections& rejections);

}  // namespace graspd::planner_detail
