#pragma once

#include <cstdint>
#include <vector>

#include "closing_axis.hpp"
#include "judgement.hpp"
#include "rejections.hpp"

namespace graspd::planner_detail {

/// [m] Between two depths of the pads: one step back a share of the tips is left beyond the
/// contact, as at a rim, whose inside a tip that reaches farther may not fit.
double insertion_step_m(const SearchConfig& search, double tip_offset_m);

/// 0 to count - 1 in the order of their bits read backwards, so that the first few are far apart.
std::vector<std::uint32_t> spread_turns(std::uint32_t count);

/// The ways in which a hand can come to a closing axis: directions about it, the first few far
/// apart, and depths.
///
/// Reach is judged by the middle lines of palm and fingers alone; a pose whose lines are blocked
/// needs no full check. A pose that falls is counted: outside_approach_cones (with its margin where
/// the lines are free), palm_line_blocked, finger_line_blocked.
std::vector<ApproachPose> find_poses(const ClosingAxis& axis, const Judgement& judgement,
                                     Rejections& rejections);

}  // namespace graspd::planner_detail
