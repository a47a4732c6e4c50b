#include "solid_properties.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graspd::mesh_detail {
namespace {

// A surface folded flat (two faces back to back) has a volume of rounding alone, and no outside.
constexpr double kNoVolume = 1e-12;

Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& vertices) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
    return box.center();
}

}  // namespace

SolidProperties integrate_solid(const TriangleMesh& mesh) {
    SolidProperties solid;
    const Eigen::Vector3d middle = middle_of(mesh.vertices);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d a = mesh.vertices[face[0]] - middle;
        const Eigen::Vector3d b = mesh.vertices[face[1]] - middle;
        const Eigen::Vector3d c = mesh.vertices[face[2]] - middle;
        const double tetrahedron = a.dot(b.cross(c)) / 6.0;
        solid.volume_m3 += tetrahedron;
        moment += tetrahedron * 0.25 * (a + b + c);
        solid.area_m2 += 0.5 * (b - a).cross(c - a).norm();
    }
    if (solid.volume_m3 != 0.0) solid.center_of_mass = middle + moment / solid.volume_m3;
    return solid;
}

std::uint32_t turn_outward(TriangleMesh& mesh, const std::vector<std::uint32_t>& patch_of_face,
                           std::uint32_t patches, DisjointSets& groups) {
    const Eigen::Vector3d middle = middle_of(mesh.vertices);
    std::vector<double> volume(patches, 0.0);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& face = mesh.faces[f];
        volume[groups.find(patch_of_face[f])] +=
            (mesh.vertices[face[0]] - middle)
                .dot((mesh.vertices[face[1]] - middle).cross(mesh.vertices[face[2]] - middle));
    }
    double largest = 0.0;
    for (const double each : volume) largest = std::max(largest, std::abs(each));
    const auto points_inward = [&](std::uint32_t group) {
        return volume[group] < -kNoVolume * largest;
    };
    std::uint32_t turned = 0;
    for (std::uint32_t patch = 0; patch < patches; ++patch) turned += points_inward(patch);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        Triangle& face = mesh.faces[f];
        if (points_inward(groups.find(patch_of_face[f]))) std::swap(face[1], face[2]);
    }
    return turned;
}

std::uint32_t count_components(const TriangleMesh& mesh) {
    DisjointSets pieces(mesh.vertices.size());
    std::uint32_t count = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Triangle& face : mesh.faces) {
        for (std::size_t k = 1; k < 3; ++k) {
            count -= pieces.find(face[0]) != pieces.find(face[k]);
            pieces.unite(face[0], face[k]);
        }
    }
    return count;
}

}  // namespace graspd::mesh_detail
