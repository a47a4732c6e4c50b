#pragma once

#include <vector>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"
#include "graspd/concavity/outer_hull.hpp"
#include "work_limits.hpp"

namespace graspd::concavity_detail {

/// Points for tetrahedra between a mesh and its hull, one about every `cell_m` in each direction:
/// in the gap's inside off a jittered grid, and on the hull's facets. All keep half a cell away
/// from the surface, else the tetrahedra between them and the surface would be thin, and on the
/// hull they would let the front begin behind a rim.
///
/// @param mesh, hull, bvh  as of tetrahedral_concavity
/// @param cell_m           [m] spacing
/// @return the points [m], in an order that depends on the input alone; kTooLarge by the limits
Result<std::vector<Eigen::Vector3d>> gap_points(const TriangleMesh& mesh, const OuterHull& hull,
                                                const TriangleBvh& bvh, double cell_m,
                                                const WorkLimits& limits);

}  // namespace graspd::concavity_detail
