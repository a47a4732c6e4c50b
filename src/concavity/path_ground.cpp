#include "path_ground.hpp"

#include "graspd/base/space_curve.hpp"

namespace graspd::concavity_detail {
namespace {

std::vector<std::uint32_t> near_order(const TriangleMesh& mesh, double diagonal_m) {
    std::vector<Eigen::Array4f> units(mesh.vertices.size(), Eigen::Array4f::Zero());
    const Eigen::Vector3d& base = mesh.vertices[mesh.faces.front()[0]];
    for (std::size_t v = 0; v < units.size(); ++v) {
        units[v].head<3>() = ((mesh.vertices[v] - base) / diagonal_m).cast<float>();
    }
    std::vector<std::uint32_t> order;
    order.reserve(units.size());
    for (const CurvePlace& place : order_on_curve(units)) order.push_back(place.number);
    return order;
}

}  // namespace

PathGround::PathGround(const TriangleMesh& of, const ConcavityConfig& config)
    : mesh(of),
      diagonal_m(mesh_diagonal_m(of)),
      offset_m(config.start_offset * diagonal_m),
      neighbours(of),
      normals(angle_weighted_normals(of)),
      order(near_order(of, diagonal_m)) {
    lifted.reserve(of.vertices.size());
    for (std::size_t v = 0; v < of.vertices.size(); ++v) {
        lifted.push_back(of.vertices[v] + offset_m * normals[v]);
    }
}

}  // namespace graspd::concavity_detail
