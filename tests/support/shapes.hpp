#pragma once

#include <cstddef>
#include <cstdint>

#include "graspd/base/geometry.hpp"
#include "support/mesh_damage.hpp"
#include "support/shape_builders.hpp"

namespace graspd::test {

// Objects with answers worked out by hand. All lengths in metres; every mesh is closed,
// two-manifold and outward oriented, with about `faces` triangles. "Concavity" is the length of the
// shortest way from a point of the surface to the convex hull outside the object.

/// Box centred at the origin. Concavity 0 everywhere. Volume x y z.
TriangleMesh box(const Eigen::Vector3d& size_m, std::size_t faces = 12);

/// Sphere centred at the origin (rings of latitude). Concavity 0 at every vertex.
TriangleMesh sphere(double radius_m, std::size_t faces = 1000);

/// Cylinder along z, centred at the origin. Concavity 0 at every vertex.
TriangleMesh cylinder(double radius_m, double height_m, std::size_t faces = 1000);

/// Channel with a U profile, open towards +z and at both ends. The gap spans x in
/// [-width/2, width/2] over the whole length, y in [-length/2, length/2]; its floor is z = 0, the
/// walls' tops z = depth, the underside z = -wall; outer sides at x = +-(width/2 + wall).
/// Concavity at (x, y, z) in the gap: min(depth - z, length/2 - |y|), both ways being straight and
/// free. Volume: length ((width + 2 wall)(depth + wall) - width depth).
TriangleMesh u_channel(double depth_m, double width_m, double wall_m, double length_m,
                       std::size_t faces = 1000);

/// Truncated wedge: a box of the size given, centred, whose x extent grows linearly from
/// bottom_width at z = -height/2 to top_width at z = height/2. The sides at +-x lean by
/// atan((top - bottom) / (2 height)) each, so they enclose twice that. Convex.
TriangleMesh wedge(double bottom_width_m, double top_width_m, double length_m, double height_m,
                   std::size_t faces = 500);

/// Oblique prism: a box centred at the origin, sheared so that its top is moved by shift along x
/// (point at height z by shift z / size.z). The sides at +-x stay parallel: a gripper closing along
/// x finds normals that lean by atan(shift / size.z) from x. Convex. Volume x y z.
TriangleMesh oblique_prism(const Eigen::Vector3d& size_m, double shift_m, std::size_t faces = 500);

/// Block centred in x and y, z in [-height, 0], with a square blind hole of the width and depth
/// given from the middle of its top. Concavity in the hole at (x, y, z): -z; on its floor: depth.
TriangleMesh blind_hole_block(const Eigen::Vector3d& size_m, double hole_width_m,
                              double hole_depth_m, std::size_t faces = 2000);

/// Cup about z, open at +z: outer radius and height, one thickness for wall and bottom; it stands
/// on z = 0. Concavity on the inside at height z: height - z; outside 0. Volume of the true cup: pi
/// (R^2 H - (R - t)^2 (H - t)).
TriangleMesh cup(double radius_m, double height_m, double thickness_m, std::size_t faces = 2000);

/// Half a spherical shell about z, open at +z, its rim in the plane z = 0, lowest point at
/// z = -radius. Concavity on the inside at depth -z: -z.
TriangleMesh bowl(double radius_m, double thickness_m, std::size_t faces = 2000);

/// Torus about z: the tube's circle of radius `tube` runs at `ring` from the axis. The hull adds
/// the two planes z = +-tube for radii up to `ring`. A point at tube angle phi (0 outside, pi at
/// the hole) has radius rho = ring + tube cos(phi), height tube sin(phi); for |phi| <= pi/2
/// concavity is 0, else tube (1 - |sin(phi)|), straight up or down. Volume 2 pi^2 ring tube^2.
TriangleMesh torus(double ring_m, double tube_m, std::size_t faces = 2000);

/// Two balls on a bar along z: ball centres at z = +-distance/2. The hull is the cylinder of the
/// balls' radius between the centres. Concavity on the bar, at radius `bar` between the balls:
/// ball - bar (straight out, free).
TriangleMesh dumbbell(double ball_radius_m, double bar_radius_m, double distance_m,
                      std::size_t faces = 2000);

/// L profile in x and z, length along y: legs of the lengths given along +x and +z, both `wall`
/// thick, outer corner at the origin, y centred. The hull's slanted plane runs through (leg_x,
/// wall) and (wall, leg_z); concavity at the inner corner (wall, wall), away from the ends: a b /
/// hypot(a, b) with a = leg_x - wall, b = leg_z - wall.
TriangleMesh l_shape(double leg_x_m, double leg_z_m, double wall_m, double length_m,
                     std::size_t faces = 1000);

/// Two discs of radius R, each `disc` thick, joined along z by a neck of radius r and length L;
/// centred at the origin. The hull is the cylinder of radius R; concavity on the neck is R - r
/// (radially out, free), on the inner faces of the discs at radius rho: R - rho.
TriangleMesh hourglass(double disc_radius_m, double neck_radius_m, double neck_length_m,
                       double disc_thickness_m, std::size_t faces = 2000);

/// The same of boxes: plates `plate_m` (x, y, thickness) joined along z by a square neck of
/// neck_width and neck_length. Concavity on the neck's side at +-x: (plate.x - neck_width)/2.
TriangleMesh box_hourglass(const Eigen::Vector3d& plate_m, double neck_width_m,
                           double neck_length_m, std::size_t faces = 2000);

/// Plate (x, y, thickness z), centred, with a square through hole of the width given.
/// Concavity in the hole at height z: thickness/2 - |z|, so at most half the thickness.
TriangleMesh plate_with_hole(const Eigen::Vector3d& size_m, double hole_width_m,
                             std::size_t faces = 2000);

/// Ring of rectangular section about z, centred: radii inner and outer, height along z.
/// Concavity on the inner side at height z: height/2 - |z|.
TriangleMesh ring(double inner_radius_m, double outer_radius_m, double height_m,
                  std::size_t faces = 2000);

}  // namespace graspd::test
