#pragma once

#include <cstdint>
#include <vector>

#include "disjoint_sets.hpp"
#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

/// Volume and centre of a closed mesh of uniform density.
struct SolidProperties {
    double volume_m3 = 0.0;
    Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< [m]
    double area_m2 = 0.0;
};

/// Integrates over the surface (divergence theorem): each face spans a tetrahedron with a fixed
/// point, here the middle of the bounding box, because far from it digits would be lost.
SolidProperties integrate_solid(const TriangleMesh& mesh);

/// Turns every group of patches whose signed volume is negative. Each group must be closed.
/// @param groups  sets of patches
/// @return how many groups were turned
std::uint32_t turn_outward(TriangleMesh& mesh, const std::vector<std::uint32_t>& patch_of_face,
                           std::uint32_t patches, DisjointSets& groups);

/// Pieces that have no vertex in common. Every vertex must be in use.
std::uint32_t count_components(const TriangleMesh& mesh);

}  // namespace graspd::mesh_detail
