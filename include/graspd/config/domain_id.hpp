#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "graspd/base/result.hpp"

namespace graspd {

/// The DDS domain to join: what --domain says, else the environment's ROS_DOMAIN_ID when it is set
/// and not empty, else 0. (Fast DDS does not read ROS_DOMAIN_ID itself.)
/// @return kInvalidInput naming --domain or ROS_DOMAIN_ID, its value and the range [0, 232]
Result<std::uint32_t> choose_domain(const std::optional<std::string>& option);

}  // namespace graspd
