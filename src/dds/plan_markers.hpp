#pragma once

#include "graspd/planner/draw_plan.hpp"
#include "wire_types.hpp"

namespace graspd::dds {

/// The picture of a plan for viewers such as RViz and Foxglove. The first marker deletes all that
/// were there; then, by namespace:
///
///     object    one list of triangles, each corner coloured by its concavity: blue where there is
///               none, over cyan, green and yellow to red at picture.deepest_m; grey: enclosed
///     regions   a list of spheres for each region, the deepest first
///     grippers  the parts of each hand: cubes, or lists of triangles; the worse the score the
///               redder, the best one opaque
///     contacts  one list of spheres, two for each grasp, coloured as its hand
///     labels    "rank: score" at each hand's mounting frame; without grasps the status above the
///               object
///
/// Ids count from 0 within a namespace. Nothing expires. Namespaces without content have no marker,
/// as viewers complain of empty lists.
///
/// @param reply   to the plan that the picture is of
/// @param header  of every marker: F, and when the object was there
/// Pure. The size is bounded by the picture's limits: 120 bytes a face of the object, 24 a point of
/// a region, 72 a face of a hand.
visualization_msgs::msg::dds_::MarkerArray_ plan_markers(
    const PlanPicture& picture, const PlanReply& reply, const std_msgs::msg::dds_::Header_& header);

}  // namespace graspd::dds
