#include "support/tested_path.hpp"

#include <algorithm>
#include <cmath>

namespace graspd::test {

using Eigen::Vector3d;

std::vector<Vector3d> lifted_vertices(const TriangleMesh& mesh, double by_m) {
    std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
    for (const Triangle& face : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d a = mesh.vertices[face[(k + 1) % 3]] - mesh.vertices[face[k]];
            const Vector3d b = mesh.vertices[face[(k + 2) % 3]] - mesh.vertices[face[k]];
            normals[face[k]] += angle_between_rad(a, b) * a.cross(b).stableNormalized();
        }
    }
    std::vector<Vector3d> points = mesh.vertices;
    for (std::size_t v = 0; v < points.size(); ++v) {
        points[v] += by_m * normals[v].stableNormalized();
    }
    return points;
}

TestedPaths::TestedPaths(const TriangleMesh& mesh, const OuterHull& hull,
                         const ConcavityField& field)
    : mesh_(mesh),
      hull_(hull),
      field_(field),
      lift_m_(ConcavityConfig{}.start_offset * mesh_diagonal_m(mesh)),
      start_(lifted_vertices(mesh, lift_m_)) {}

std::vector<Vector3d> TestedPaths::path(std::uint32_t vertex) const {
    std::vector<Vector3d> points;
    if (!std::isfinite(field_.value_m[vertex])) return points;
    std::int32_t at = static_cast<std::int32_t>(vertex);
    while (at >= 0 && points.size() <= mesh_.vertices.size()) {
        points.push_back(start_[static_cast<std::size_t>(at)]);
        at = field_.parent[static_cast<std::size_t>(at)];
    }
    if (at < 0 && at != ConcavityField::kNoParent) {
        const HullFacet& facet = hull_.facets[static_cast<std::size_t>(-1 - at)];
        const double gap_m = facet.offset_m - facet.normal.dot(points.back()) - lift_m_;
        points.push_back(points.back() + std::max(0.0, gap_m) * facet.normal);
    }
    return points;
}

}  // namespace graspd::test
