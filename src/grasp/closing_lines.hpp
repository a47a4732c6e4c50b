#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/triangle_bvh.hpp"

namespace graspd::grasp_detail {

/// A place where a line along Gx enters the object.
struct LineHit {
    Eigen::Vector3d point_G;  ///< [m]
    double advance_m = 0.0;   ///< [m] from where the line begins
    std::uint32_t face = 0;   ///< of the mesh
};

/// What a closing finger sees: lines along Gx at every pair of y and z, row by row, as far as the
/// other finger's start.
/// @param y_G, z_G      [m]
/// @param half_reach_m  [m] the lines begin so far from the TCP
/// @param side          -1 for the finger that comes from -Gx, else 1
/// @return the lines that hit; none when a line begins inside the object
std::optional<std::vector<LineHit>> closing_lines(const TriangleBvh& tree_W,
                                                  const Eigen::Isometry3d& X_WG,
                                                  std::span<const double> y_G,
                                                  std::span<const double> z_G, double half_reach_m,
                                                  double side);

}  // namespace graspd::grasp_detail
