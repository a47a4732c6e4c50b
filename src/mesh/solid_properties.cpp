#include "solid_properties.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graspd/base/stop.hpp"
#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

// A surface folded flat (two faces back to back) has a volume of rounding alone, and no outside.
constexpr double kNoVolume = 1e-12;

Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& vertices) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
    return box.center();
}

/// Integrates about a point; `six_volumes(face, 6 volume of its tetrahedron)` hears of every face.
template <class PerFace>
SolidProperties integrate_about(const TriangleMesh& mesh, const Eigen::Vector3d& middle,
                                PerFace&& six_volumes) {
    SolidProperties solid;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        stop_point(f);
        const Triangle& face = mesh.faces[f];
        const Eigen::Vector3d a = mesh.vertices[face[0]] - middle;
        const Eigen::Vector3d b = mesh.vertices[face[1]] - middle;
        const Eigen::Vector3d c = mesh.vertices[face[2]] - middle;
        const double six = a.dot(b.cross(c));
        six_volumes(f, six);
        const double tetrahedron = six / 6.0;
        solid.volume_m3 += tetrahedron;
        moment += tetrahedron * 0.25 * (a + b + c);
    }
    if (solid.volume_m3 != 0.0) solid.center_of_mass = middle + moment / solid.volume_m3;
    return solid;
}

}  // namespace

OutwardSolid turn_outward(TriangleMesh& mesh, const std::vector<std::uint32_t>& patch_of_face,
                          std::uint32_t patches, DisjointSets& groups) {
    const Eigen::Vector3d middle = middle_of(mesh.vertices);
    std::vector<std::uint32_t> group_of_patch(patches);
    for (std::uint32_t patch = 0; patch < patches; ++patch) {
        group_of_patch[patch] = groups.find(patch);
    }
    std::vector<double> volume(patches, 0.0);  // six-fold, per group
    OutwardSolid outward;
    outward.solid = integrate_about(mesh, middle, [&](std::size_t f, double six) {
        volume[group_of_patch[patch_of_face[f]]] += six;
    });
    double largest = 0.0;
    for (const double each : volume) largest = std::max(largest, std::abs(each));
    const auto points_inward = [&](std::uint32_t group) {
        return volume[group] < -kNoVolume * largest;
    };
    for (std::uint32_t group = 0; group < patches; ++group) outward.turned += points_inward(group);
    if (outward.turned == 0) return outward;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        Triangle& face = mesh.faces[f];
        if (points_inward(group_of_patch[patch_of_face[f]])) std::swap(face[1], face[2]);
    }
    outward.solid = integrate_about(mesh, middle, [](std::size_t, double) {});
    return outward;
}

double surface_area_m2(const TriangleMesh& mesh) {
    double area_m2 = 0.0;
    stop_point();
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.vertices[face[0]];
        area_m2 += 0.5 * (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a).norm();
    }
    return area_m2;
}

std::uint32_t count_components(const TriangleMesh& mesh,
                               const std::vector<std::uint32_t>& patch_of_face,
                               std::uint32_t patches) {
    if (patches == 1) return 1;
    DisjointSets pieces(patches);
    std::uint32_t count = patches;
    std::vector<std::uint32_t> patch_of_vertex(mesh.vertices.size(), kNone);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        stop_point(f);
        const std::uint32_t patch = patch_of_face[f];
        for (const std::uint32_t vertex : mesh.faces[f]) {
            std::uint32_t& known = patch_of_vertex[vertex];
            if (known == kNone) known = patch;
            if (known == patch) continue;
            count -= pieces.find(known) != pieces.find(patch);
            pieces.unite(known, patch);
        }
    }
    return count;
}

}  // namespace graspd::mesh_detail
