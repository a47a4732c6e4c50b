#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "judgement.hpp"
#include "rejections.hpp"

namespace graspd::planner_detail {

/// Puts closing axes in the order in which they are worth a full check: those on which a single
/// line sees two touches that lean little from it and lie near the centre of mass first.
///
/// An axis that falls is counted: axis_no_contact, axis_leans, axis_too_wide (with its margin).
/// @return the axes, best first, their places moved to where the line touches
std::vector<ClosingAxis> order_axes(std::vector<ClosingAxis> axes, const Judgement& judgement,
                                    Rejections& rejections);

/// Whether two axes are the same for a person (thresholds of rank_grasps).
bool similar(const ClosingAxis& a, const ClosingAxis& b, const Judgement& judgement);

}  // namespace graspd::planner_detail
