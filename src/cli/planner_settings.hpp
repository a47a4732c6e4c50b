#pragma once

#include <string>

#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// The planner's settings from a file (empty: the defaults).
/// @param concavity_method  takes the place of the file's vertex_concavity.method unless empty
Result<PlannerConfig> planner_settings(const std::string& config_file,
                                       const std::string& concavity_method);

}  // namespace graspd::cli
