#pragma once

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// The surface's own frame P: origin at its centre of area, axes by falling spread of its area.
///
/// Source: none in the paper. All later stages work in P, so that a turned or shifted object, or
/// one whose vertices come in another order, gives the same grasps.
/// Signs: third moment of the area >= 0 along the first and the second axis; where it vanishes
/// (below 1e-9 of the spread's cube) the axis's largest component is made positive. The third axis
/// completes a right-handed frame. Axes of equal spread come as the decomposition gives them.
///
/// @param mesh_O  faces of non-zero area in all [m]; the exact integrals over the triangles depend
///                on the shape alone, not on how it is cut into triangles
/// @return X_OP; kDegenerate when the surface has no area or a value is not finite
/// Complexity O(F). Pure, so safe to call from any thread.
Result<Eigen::Isometry3d> principal_frame(const TriangleMesh& mesh_O);

/// A mesh with every vertex multiplied by a pose.
TriangleMesh transformed(const Eigen::Isometry3d& X_new_old, const TriangleMesh& mesh_old);

}  // namespace graspd
