#pragma once

#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

/// Every vertex lifted off the surface along the mean of its faces' normals, weighted by angle [m].
/// Worked out here anew.
std::vector<Eigen::Vector3d> lifted_vertices(const TriangleMesh& mesh, double by_m);

}  // namespace graspd::test
