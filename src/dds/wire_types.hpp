#pragma once

#include <graspd_msgs/graspd.h>

namespace graspd::dds {

namespace wire = ::graspd_msgs::msg::dds_;

}  // namespace graspd::dds
