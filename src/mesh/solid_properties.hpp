#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/disjoint_sets.hpp"
#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

/// Volume and centre of a closed mesh of uniform density.
struct SolidProperties {
    double volume_m3 = 0.0;
    Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< [m]
};

/// A solid whose surfaces were turned outward.
struct OutwardSolid {
    SolidProperties solid;
    std::uint32_t turned = 0;  ///< groups of patches that pointed inward
};

/// Turns every group of patches whose signed volume is negative, and measures what comes out. Each
/// group must be closed. Integrates over the surface (divergence theorem): each face spans a
/// tetrahedron with a fixed point, here the middle of the bounding box, because far from it digits
/// would be lost.
/// @param groups  sets of patches
OutwardSolid turn_outward(TriangleMesh& mesh, const std::vector<std::uint32_t>& patch_of_face,
                          std::uint32_t patches, DisjointSets& groups);

/// Area of all faces [m^2].
double surface_area_m2(const TriangleMesh& mesh);

/// Pieces that have no vertex in common. Every vertex must be in use.
/// @param patch_of_face  faces of a patch hang together
std::uint32_t count_components(const TriangleMesh& mesh,
                               const std::vector<std::uint32_t>& patch_of_face,
                               std::uint32_t patches);

}  // namespace graspd::mesh_detail
