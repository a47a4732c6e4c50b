#pragma once

#include <cstdint>
#include <vector>

#include "graspd/concavity/shortest_path_concavity.hpp"

namespace graspd::test {

/// Every vertex lifted off the surface along the mean of its faces' normals, weighted by angle [m].
/// Worked out here anew.
std::vector<Eigen::Vector3d> lifted_vertices(const TriangleMesh& mesh, double by_m);

/// The polylines that rays proved free, vertex and bends lifted off the surface, the last point one
/// lift short of the hull's plane, as the object's own sides may lie in that.
class TestedPaths {
public:
    /// Keeps references to its arguments.
    TestedPaths(const TriangleMesh& mesh, const OuterHull& hull, const ConcavityField& field);
    std::vector<Eigen::Vector3d> path(std::uint32_t vertex) const;

private:
    const TriangleMesh& mesh_;
    const OuterHull& hull_;
    const ConcavityField& field_;
    double lift_m_ = 0.0;
    std::vector<Eigen::Vector3d> start_;
};

}  // namespace graspd::test
