#pragma once

#include <cstddef>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

// Blocks with a square blind tunnel, 20 mm wide, that starts in the top (the plane z = 0) and turns
// twice. All walls are 20 mm or thicker. The hull is the block, and out of the
// tunnel there is no other way than through its mouth.

/// Down, along +x, down again: the turns lie in the plane y = 0. Closed, outward oriented.
TriangleMesh tunnel_2d(std::size_t faces);

/// Concavity of a vertex of tunnel_2d [m], in closed form: up to two bends, at corners of the
/// tunnel's outline in the plane of x and z. y never changes along a shortest way: taking it as
/// constant shortens any way and keeps it in the tunnel.
double tunnel_2d_concavity_m(const Eigen::Vector3d& vertex);

/// Down, along +x, then along +y: floor and ceiling of the two lower legs are planes that fall by
/// 1 in 4 towards +y, so that the lip E1 over which the way turns up is not parallel to the hull's
/// top. Closed, outward oriented.
TriangleMesh tunnel_3d(std::size_t faces);

/// Concavity of a vertex of tunnel_3d [m]. From the last leg the way bends over the interior of the
/// upright edge E2, the interior of E1, and goes straight up from there. Each leg is convex, so the
/// length is a convex function of the points where the way passes from one to the next; all but
/// the place on E1 is minimised in closed form, that by golden section (to 1e-12 of the length).
double tunnel_3d_concavity_m(const Eigen::Vector3d& vertex);

/// Length of the way from a vertex of tunnel_3d's last leg by the point of E2 at height z and the
/// point of E1 at y [m]: what a search over both has to minimise. For tests of the above.
double tunnel_3d_way_m(const Eigen::Vector3d& vertex, double z_on_E2_m, double y_on_E1_m);

}  // namespace graspd::test
