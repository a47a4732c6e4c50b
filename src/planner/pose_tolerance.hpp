#pragma once

#include "judgement.hpp"

namespace graspd::planner_detail {

/// How far the hand may be off a grasp's pose: the largest errors of the tried ones (the greatest
/// of the config, halved so many times) at which the grasp, off by so much to either side along
/// every axis of the grasp frame, or turned so far about every one, is still free all the way and
/// more likely to hold than not. Along Gx the pads' distance from the object at the open width
/// bounds the shift: beyond it a pad lands on the object. Source: none in the paper, which plans
/// for exact poses.
///
/// @param grasp  [m] in F; of the judgement's gripper
/// @return zeros where even the least error is too much
/// Cost: about 20 poses; at most 10 a size of error and kind. Pure, so safe to call from any
/// thread.
PoseTolerance pose_tolerance(const Grasp& grasp, const Judgement& judgement);

}  // namespace graspd::planner_detail
