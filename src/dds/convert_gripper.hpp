#pragma once

#include <span>
#include <vector>

#include "convert_basics.hpp"
#include "graspd/base/gripper.hpp"

namespace graspd::dds {

/// The grippers of a request: the profile it names, or those that it brings along, never both.
/// Notes kUnknownGripper with the known names, kUnsupported for convex parts, or what validate()
/// says of an inline one.
std::vector<Gripper> read_grippers(const wire::GraspRequest_& request,
                                   std::span<const Gripper> known, FirstError& errors);

wire::Gripper_ write_gripper(const Gripper& gripper);

}  // namespace graspd::dds
