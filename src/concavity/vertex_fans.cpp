#include "vertex_fans.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace graspd::concavity_detail {

VertexNeighbours::VertexNeighbours(const TriangleMesh& mesh) : start_(mesh.vertices.size() + 1, 0) {
    // Every face notes both other corners at each of its own; then rows are sorted and closed up.
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t v : face) start_[v + 1] += 2;
    }
    for (std::size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
    neighbour_.resize(start_.back());
    std::vector<std::uint32_t> place(start_.begin(), start_.end() - 1);
    for (const Triangle& face : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            neighbour_[place[face[k]]++] = face[(k + 1) % 3];
            neighbour_[place[face[k]]++] = face[(k + 2) % 3];
        }
    }
    auto write = neighbour_.begin();
    std::uint32_t first = 0;
    for (std::size_t v = 0; v + 1 < start_.size(); ++v) {
        const auto begin = neighbour_.begin() + first, end = neighbour_.begin() + start_[v + 1];
        first = start_[v + 1];
        std::sort(begin, end);
        start_[v] = static_cast<std::uint32_t>(write - neighbour_.begin());
        write = std::copy(begin, std::unique(begin, end), write);
    }
    start_.back() = static_cast<std::uint32_t>(write - neighbour_.begin());
    neighbour_.erase(write, neighbour_.end());
}

std::vector<Eigen::Vector3d> angle_weighted_normals(const TriangleMesh& mesh) {
    std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.vertices[face[0]];
        const Eigen::Vector3d ab = mesh.vertices[face[1]] - a;
        const Eigen::Vector3d ac = mesh.vertices[face[2]] - a;
        const Eigen::Vector3d bc = ac - ab;
        const Eigen::Vector3d cross = ab.cross(ac);
        const double twice_area = cross.norm();
        if (!(twice_area > 0.0)) continue;
        const Eigen::Vector3d normal = cross / twice_area;
        normals[face[0]] += std::atan2(twice_area, ab.dot(ac)) * normal;
        normals[face[1]] += std::atan2(twice_area, -ab.dot(bc)) * normal;
        normals[face[2]] += std::atan2(twice_area, ac.dot(bc)) * normal;
    }
    for (Eigen::Vector3d& normal : normals) normal.stableNormalize();
    return normals;
}

}  // namespace graspd::concavity_detail
