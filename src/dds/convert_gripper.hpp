#pragma once

#include <span>
#include <string>
#include <vector>

#include "convert_basics.hpp"
#include "graspd/base/gripper.hpp"

namespace graspd::dds {

/// The grippers of a request: the profile it names, or those that it brings along, never both.
/// Notes kUnknownGripper with the known names, or what is wrong with an inline one: validate(), a
/// convex part without a volume.
std::vector<Gripper> read_grippers(const wire::GraspRequest_& request,
                                   std::span<const Gripper> known, FirstError& errors);

/// Their names, for messages: "a, b", or "none".
std::string names_of(std::span<const Gripper> known);

/// A gripper for a request. The wire has no linkage: one that has some goes as the boxes around it.
wire::Gripper_ write_gripper(const Gripper& gripper);

}  // namespace graspd::dds
