#include "path_ground.hpp"

#include <algorithm>
#include <cmath>

#include "graspd/base/space_curve.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::concavity_detail {
namespace {

std::vector<std::uint32_t> near_order(const TriangleMesh& mesh, double diagonal_m) {
    std::vector<Eigen::Array4f> units(mesh.vertices.size(), Eigen::Array4f::Zero());
    const Eigen::Vector3d& base = mesh.vertices[mesh.faces.front()[0]];
    for (std::size_t v = 0; v < units.size(); ++v) {
        units[v].head<3>() = ((mesh.vertices[v] - base) / diagonal_m).cast<float>();
    }
    stop_point();
    std::vector<std::uint32_t> order;
    order.reserve(units.size());
    for (const CurvePlace& place : order_on_curve(units)) order.push_back(place.number);
    return order;
}

/// Of a thousand edges, evenly spread [m].
double mean_edge(const TriangleMesh& mesh) {
    const std::size_t step = 1 + mesh.faces.size() / 1024;
    double sum_m = 0.0, count = 0.0;
    for (std::size_t f = 0; f < mesh.faces.size(); f += step) {
        const Triangle& face = mesh.faces[f];
        sum_m += (mesh.vertices[face[1]] - mesh.vertices[face[0]]).norm();
        count += 1.0;
    }
    return sum_m / count;
}

/// Per vertex the sine of the widest angle between its normal and one of its faces'; 1 from a right
/// angle on.
std::vector<float> spread_of_fans(const TriangleMesh& mesh,
                                  const std::vector<Eigen::Vector3d>& normals) {
    std::vector<float> least(mesh.vertices.size(), 1.0F);  // cosine
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        stop_point(f);
        const Triangle& face = mesh.faces[f];
        const Eigen::Vector3d& a = mesh.vertices[face[0]];
        const Eigen::Vector3d cross =
            (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a);
        const double area = cross.norm();
        if (!(area > 0.0)) continue;
        for (const std::uint32_t v : face) {
            least[v] = std::min(least[v], static_cast<float>(normals[v].dot(cross) / area));
        }
    }
    for (float& each : least) each = std::sqrt(1.0F - std::max(each, 0.0F) * std::max(each, 0.0F));
    return least;
}

/// Per vertex whether an edge leads below the plane of its normal: over one where none does, flat
/// or hollow, no string is taut.
std::vector<char> falling_fans(const TriangleMesh& mesh,
                               const std::vector<Eigen::Vector3d>& normals) {
    constexpr double kFlat = 1e-3;  // sine
    std::vector<char> falls(mesh.vertices.size(), 0);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        stop_point(f);
        const Triangle& face = mesh.faces[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = face[k];
            const Eigen::Vector3d edge = mesh.vertices[face[(k + 1) % 3]] - mesh.vertices[v];
            const double rise = edge.dot(normals[v]);
            falls[v] |= rise < 0.0 && rise * rise > kFlat * kFlat * edge.squaredNorm();
        }
    }
    return falls;
}

}  // namespace

PathGround::PathGround(const TriangleMesh& of, const ConcavityConfig& config)
    : mesh(of),
      diagonal_m(mesh_diagonal_m(of)),
      offset_m(config.start_offset * diagonal_m),
      mean_edge_m(mean_edge(of)),
      neighbours(of),
      normals(angle_weighted_normals(of)),
      spread(spread_of_fans(of, normals)),
      can_bend(falling_fans(of, normals)),
      order(near_order(of, diagonal_m)) {
    lifted.reserve(of.vertices.size());
    for (std::size_t v = 0; v < of.vertices.size(); ++v) {
        stop_point(v);
        lifted.push_back(of.vertices[v] + offset_m * normals[v]);
    }
}

}  // namespace graspd::concavity_detail
