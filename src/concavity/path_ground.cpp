#include "path_ground.hpp"

#include <algorithm>
#include <cmath>

#include "graspd/base/parallel.hpp"
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

}  // namespace

PathGround::PathGround(const TriangleMesh& of, const ConcavityConfig& config)
    : mesh(of),
      diagonal_m(mesh_diagonal_m(of)),
      offset_m(config.start_offset * diagonal_m),
      mean_edge_m(mean_edge(of)) {
    run_together({[&] { neighbours = VertexNeighbours(of); },
                  [&] { corners = corners_of_faces(of); },
                  [&] { order = near_order(of, diagonal_m); }});
    const std::size_t count = of.vertices.size();
    normals.resize(count);
    lifted.resize(count);
    spread.resize(count);
    can_bend.resize(count);
    constexpr std::size_t kVerticesAtATime = 2048;
    for_blocks(count, kVerticesAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v) look_around(static_cast<std::uint32_t>(v));
    });
}

/// Normal, lift, and what strings may lie over the vertex.
void PathGround::look_around(std::uint32_t vertex) {
    const auto faces = neighbours.faces_of(vertex);
    const Eigen::Vector3d& place = mesh.vertices[vertex];
    const Eigen::Vector3d normal = angle_weighted_normal(mesh, vertex, faces, corners);
    normals[vertex] = normal;
    lifted[vertex] = place + offset_m * normal;
    double least = 1.0;  // cosine
    for (const std::uint32_t f : faces) {
        if (corners[f].normal.isZero(0.0)) continue;  // no area
        least = std::min(least, normal.dot(corners[f].normal));
    }
    least = std::max(least, 0.0);
    spread[vertex] = static_cast<float>(std::sqrt(1.0 - least * least));
    constexpr double kFlat = 1e-3;  // sine
    can_bend[vertex] = std::ranges::any_of(neighbours.of(vertex), [&](std::uint32_t next) {
        const Eigen::Vector3d edge = mesh.vertices[next] - place;
        const double rise = edge.dot(normal);
        return rise < 0.0 && rise * rise > kFlat * kFlat * edge.squaredNorm();
    });
}

}  // namespace graspd::concavity_detail
