#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"

namespace graspd::collision_detail {

/// Corners of a triangle, in any frame.
using Corners = std::array<Eigen::Vector3d, 3>;

/// Those of a face.
inline Corners corners_of(const TriangleMesh& mesh, std::uint32_t face) {
    const Triangle& t = mesh.faces[face];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Least distance between a solid box and a triangle in the same frame, 0 where they meet.
///
/// Exact up to rounding. FCL's distance by libccd is not where the nearest point lies straight
/// before the middle of a face: it over-estimates by up to a tenth there, whatever its tolerance.
/// @param most_m  [m] > 0: a greater distance is reported as most_m, which is cheaper
double distance_m(const OrientedBox& box, const Corners& triangle, double most_m);

/// Least distance between two solid boxes in the same frame, 0 where they meet.
double distance_m(const OrientedBox& a, const OrientedBox& b, double most_m);

}  // namespace graspd::collision_detail
