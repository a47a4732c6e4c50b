#pragma once

#include <filesystem>

#include "graspd/base/gripper.hpp"
#include "yaml_scalar.hpp"

namespace graspd::config_detail {

/// A gripper from a profile with the key `urdf`; keys and errors as in load_gripper().
Result<Gripper> load_urdf_gripper(const std::filesystem::path& file, const YAML::Node& root);

/// A list of three numbers.
std::optional<PlanError> read_point(const std::filesystem::path& file, const YAML::Node& node,
                                    const std::string& key, Eigen::Vector3d& point);

}  // namespace graspd::config_detail
