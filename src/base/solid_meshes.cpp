#include "graspd/base/solid_meshes.hpp"

#include <cmath>
#include <numbers>

namespace graspd {
namespace {

constexpr std::uint32_t kBands = kCircleCorners / 2;  // of a sphere: as high as they are wide

/// Adds the corners of a circle about z, from +x by way of +y. @return index of the first
std::uint32_t add_ring(TriangleMesh& mesh, double radius_m, double z_m) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i < kCircleCorners; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / kCircleCorners;
        mesh.vertices.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad),
                                   z_m);
    }
    return first;
}

std::uint32_t next(std::uint32_t corner) {
    return (corner + 1) % kCircleCorners;
}

/// Joins a ring to the one above it.
void add_band(TriangleMesh& mesh, std::uint32_t lower, std::uint32_t upper) {
    for (std::uint32_t i = 0; i < kCircleCorners; ++i) {
        mesh.faces.push_back({lower + i, lower + next(i), upper + next(i)});
        mesh.faces.push_back({lower + i, upper + next(i), upper + i});
    }
}

/// Joins a ring to a point above it.
void add_tip(TriangleMesh& mesh, std::uint32_t ring, const Eigen::Vector3d& tip) {
    const auto top = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(tip);
    for (std::uint32_t i = 0; i < kCircleCorners; ++i) {
        mesh.faces.push_back({ring + i, ring + next(i), top});
    }
}

/// Closes the ring at the lower end.
void add_floor(TriangleMesh& mesh, std::uint32_t ring) {
    for (std::uint32_t i = 1; i + 1 < kCircleCorners; ++i) {
        mesh.faces.push_back({ring, ring + i + 1, ring + i});
    }
}

}  // namespace

TriangleMesh box_mesh(const Eigen::Vector3d& size_m) {
    TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner) {  // bits: x, y, z
        const Eigen::Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                                   (corner & 4) != 0 ? 0.5 : -0.5);
        mesh.vertices.emplace_back(sign.cwiseProduct(size_m));
    }
    mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh sphere_mesh(double radius_m) {
    TriangleMesh mesh;
    std::uint32_t ring = 0;
    for (std::uint32_t band = 1; band < kBands; ++band) {  // from the south
        const double angle_rad = std::numbers::pi * band / kBands;
        const std::uint32_t upper =
            add_ring(mesh, radius_m * std::sin(angle_rad), -radius_m * std::cos(angle_rad));
        if (band > 1) add_band(mesh, ring, upper);
        ring = upper;
    }
    add_tip(mesh, ring, {0.0, 0.0, radius_m});
    const auto south = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(0.0, 0.0, -radius_m);
    for (std::uint32_t i = 0; i < kCircleCorners; ++i) mesh.faces.push_back({south, next(i), i});
    return mesh;
}

TriangleMesh cylinder_mesh(double height_m, double radius_m) {
    TriangleMesh mesh;
    const std::uint32_t lower = add_ring(mesh, radius_m, -0.5 * height_m);
    const std::uint32_t upper = add_ring(mesh, radius_m, 0.5 * height_m);
    add_floor(mesh, lower);
    add_band(mesh, lower, upper);
    for (std::uint32_t i = 1; i + 1 < kCircleCorners; ++i) {
        mesh.faces.push_back({upper, upper + i, upper + i + 1});
    }
    return mesh;
}

TriangleMesh cone_mesh(double height_m, double radius_m) {
    TriangleMesh mesh;
    const std::uint32_t ring = add_ring(mesh, radius_m, -0.5 * height_m);
    add_floor(mesh, ring);
    add_tip(mesh, ring, {0.0, 0.0, 0.5 * height_m});
    return mesh;
}

}  // namespace graspd
