#pragma once

#include <string>

#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// The planner's settings from a file (empty: the defaults), with --concavity on top.
Result<PlannerConfig> planner_settings(const std::string& config_file,
                                       const std::string& concavity_method);

}  // namespace graspd::cli
