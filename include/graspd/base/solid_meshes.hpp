#pragma once

#include <cstdint>

#include "graspd/base/geometry.hpp"

namespace graspd {

// Simple solids as closed meshes, faces counter-clockwise seen from outside. Each stands about its
// own origin, the middle of its bounding box; cylinder and cone stand along z, the cone's tip up:
// the conventions of shape_msgs/SolidPrimitive. Curved surfaces are inscribed: every vertex lies on
// the surface, and no place of the mesh is further than a chord error from it. Extents must be
// positive and finite. Pure.

/// Corners of the regular polygon in place of a circle.
inline constexpr std::uint32_t kCircleCorners = 64;
/// [1] of the radius, greatest distance of cylinder_mesh() and cone_mesh() from the surface:
/// 1 - cos(pi / 64). The volume is 0.99839 of the solid's: 32 / pi sin(pi / 32).
inline constexpr double kCircleChordError = 0.001205;
/// [1] of the radius, the same of sphere_mesh(), whose faces span both angles. The volume is at
/// least 0.992 of the sphere's, as the mesh holds the sphere that is smaller by this.
inline constexpr double kSphereChordError = 0.0025;

/// 12 faces. @param size_m  [m] along x, y and z
TriangleMesh box_mesh(const Eigen::Vector3d& size_m);
/// 64 meridians, 32 bands: 3968 faces.
TriangleMesh sphere_mesh(double radius_m);
/// 252 faces: 64 sides, both ends without a vertex in the middle.
TriangleMesh cylinder_mesh(double height_m, double radius_m);
/// 126 faces.
TriangleMesh cone_mesh(double height_m, double radius_m);

}  // namespace graspd
