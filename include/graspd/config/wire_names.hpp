#pragma once

#include "graspd/base/result.hpp"
#include "graspd/base/wire_names.hpp"
#include "graspd/config/ros_arguments.hpp"

namespace graspd {

/// The topics of a node that was started with these arguments. Topics and services have relative
/// names ("graspd/grasp_request"), so that a namespace moves them and another node name does not;
/// /diagnostics is absolute.
/// @return kInvalidInput for a name that ROS 2 does not allow
Result<WireNames> wire_names(const RosArguments& ros);

}  // namespace graspd
