#pragma once

#include <vector>

#include "closing_axis.hpp"
#include "judgement.hpp"
#include "rejections.hpp"

namespace graspd::planner_detail {

/// Chooses the closing axes that are followed up, and from where: those on which a single line
/// sees two touches that lean little from it and lie near the centre of mass, that a hand can
/// reach, and that are not alike.
///
/// Reach is judged by the middle lines of palm and fingers alone; a pose whose lines are blocked
/// needs no full check. Everything that falls is counted: an axis as axis_no_contact, axis_leans,
/// axis_too_wide, axis_out_of_reach, axis_similar or axis_surplus, a pose of a chosen axis as
/// outside_approach_cones, palm_line_blocked or finger_line_blocked.
/// @param most  how many axes are kept at most
/// @return the axes, best first, their places moved to where the line touches, with the poses that
///         remain
std::vector<ClosingAxis> choose_axes(std::vector<ClosingAxis> axes, std::uint32_t most,
                                     const Judgement& judgement, Rejections& rejections);

}  // namespace graspd::planner_detail
