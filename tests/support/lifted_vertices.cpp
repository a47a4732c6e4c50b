#include "support/lifted_vertices.hpp"

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

}  // namespace graspd::test
