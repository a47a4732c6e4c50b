#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd::grasp_detail {

/// A place where a line along Gx enters the object.
struct LineHit {
    Eigen::Vector3d point_G;  ///< [m]
    double advance_m = 0.0;   ///< [m] from where the line begins
    std::uint32_t face = 0;   ///< of the mesh
};

/// What two closing fingers see of the object: the lines that hit, row by row.
struct ClosingLines {
    std::vector<LineHit> left, right;  ///< of the finger that comes from -Gx, and of the other
};

/// Lines along Gx at every pair of y and z, from either finger as far as the other one's start.
/// @param y_G, z_G      [m]
/// @param half_reach_m  [m] the lines begin so far from the TCP
/// @return kDegenerate when a line begins inside the object: a finger cannot stand there
Result<ClosingLines> closing_lines(const TriangleBvh& tree_W, const Eigen::Isometry3d& X_WG,
                                   std::span<const double> y_G, std::span<const double> z_G,
                                   double half_reach_m);

}  // namespace graspd::grasp_detail
