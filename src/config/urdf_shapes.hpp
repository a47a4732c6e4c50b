#pragma once

#include <filesystem>
#include <vector>

#include <urdf_model/link.h>

#include "graspd/base/result.hpp"

#include <Eigen/Geometry>

namespace graspd::config_detail {

Eigen::Isometry3d pose_of(const urdf::Pose& pose);

/// Corners of a hull that holds a geometry, in its own frame [m].
/// @param file  the URDF, from which paths of meshes are looked up
Result<std::vector<Eigen::Vector3d>> corners_of(const urdf::Geometry& geometry,
                                                const std::filesystem::path& file);

}  // namespace graspd::config_detail
