#include "vertex_fans.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "graspd/base/parallel.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::concavity_detail {
namespace {

/// Angle whose tangent is y / x, for y >= 0, to 1.2e-5 rad.
double quick_angle(double y, double x) {
    const double wide = std::abs(x);
    const double t = std::min(y, wide) / std::max(y, wide);
    const double t2 = t * t;
    const double series =
        0.9998660 + t2 * (-0.3302995 + t2 * (0.1801410 + t2 * (-0.0851330 + t2 * 0.0208351)));
    const double low = t * series;  // in [0, pi / 4]
    const double first = y > wide ? 0.5 * std::numbers::pi - low : low;
    return x < 0.0 ? std::numbers::pi - first : first;
}

}  // namespace

VertexNeighbours::VertexNeighbours(const TriangleMesh& mesh) : start_(mesh.vertices.size() + 1, 0) {
    // Rows grow from their ends, so that `start_` needs no copy: first each row's end, last its
    // start.
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t v : face) ++start_[v];
    }
    stop_point();
    std::uint32_t end = 0;
    for (std::uint32_t& row : start_) row = end += row;
    neighbour_.resize(end);
    face_.resize(end);
    for (std::size_t f = mesh.faces.size(); f-- > 0;) {
        stop_point(f);
        const Triangle& face = mesh.faces[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t place = --start_[face[k]];
            neighbour_[place] = face[(k + 1) % 3];
            face_[place] = static_cast<std::uint32_t>(f);
        }
    }
}

std::vector<FaceCorners> corners_of_faces(const TriangleMesh& mesh) {
    constexpr std::size_t kFacesAtATime = 4096;
    std::vector<FaceCorners> corners(mesh.faces.size());
    for_blocks(corners.size(), kFacesAtATime, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) {
            const Triangle& face = mesh.faces[f];
            const Eigen::Vector3d& a = mesh.vertices[face[0]];
            const Eigen::Vector3d ab = mesh.vertices[face[1]] - a;
            const Eigen::Vector3d ac = mesh.vertices[face[2]] - a;
            const Eigen::Vector3d cross = ab.cross(ac);
            const double twice_area = cross.norm();
            if (!(twice_area > 0.0)) continue;
            const double at_a = quick_angle(twice_area, ab.dot(ac));
            const double at_b = quick_angle(twice_area, -ab.dot(ac - ab));
            corners[f] = {cross / twice_area, {at_a, at_b, std::numbers::pi - at_a - at_b}};
        }
    });
    return corners;
}

Eigen::Vector3d angle_weighted_normal(const TriangleMesh& mesh, std::uint32_t vertex,
                                      std::span<const std::uint32_t> faces_of_vertex,
                                      std::span<const FaceCorners> corners) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t f : faces_of_vertex) {
        const auto corner = std::ranges::find(mesh.faces[f], vertex) - mesh.faces[f].begin();
        sum += corners[f].angle_rad[corner] * corners[f].normal;
    }
    return sum.stableNormalized();
}

}  // namespace graspd::concavity_detail
