#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// Limits and tolerances of mesh conditioning.
struct ConditionMeshConfig {
    double weld_tolerance = 1e-7;  ///< [1] fraction of the bounding box's diagonal
    std::uint32_t max_vertices = 2000000;
    std::uint32_t max_faces = 4000000;
    double min_solidity = 1e-6;  ///< [1] |volume| / diagonal^3 below which it is a sheet
    bool alpha_wrap = true;      ///< wrap what has no outside; false: refuse a sheet
    double wrap_alpha = 0.03;    ///< [1] of the diagonal: hollows with narrower mouths are closed
    double wrap_offset = 0.001;  ///< [1] of the diagonal: the wrap's distance from the faces

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("weld_tolerance", self.weld_tolerance, 0.0, 1e-3);
        visit("max_vertices", self.max_vertices, 4u, 100000000u);
        visit("max_faces", self.max_faces, 4u, 200000000u);
        visit("min_solidity", self.min_solidity, 0.0, 0.1);
        visit("alpha_wrap", self.alpha_wrap);
        // A wrap has at most some alpha^-3 triangles: the lower limit bounds its time and memory.
        visit("wrap_alpha", self.wrap_alpha, 0.01, 0.3);
        visit("wrap_offset", self.wrap_offset, 1e-4, 0.03);
    }
};

/// A closed, consistently oriented mesh and how it came about.
struct ConditionedMesh {
    TriangleMesh mesh;                          ///< same frame as the input [m]
    std::vector<std::int32_t> vertex_of_input;  ///< per input vertex: index in mesh.vertices, or
                                                ///< -1 when no face kept uses it
    bool alpha_wrapped = false;  ///< the mesh is a wrap: vertex_of_input names the nearest vertex
    std::uint32_t fill_vertices = 0;  ///< the last so many vertices close holes
    double volume_m3 = 0.0;           ///< [m^3] > 0
    Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< [m] uniform density
    std::vector<Finding> findings;                             ///< what was repaired, with counts
};

/// Makes a closed oriented mesh of any triangle soup: welds equal vertices, drops degenerate and
/// duplicate faces and unreferenced vertices, orients neighbours consistently over two-manifold
/// edges, fills boundary loops with a fan about their centroid, and turns every connected
/// component outward by its signed volume. Nothing is changed without a finding:
/// vertices_welded, degenerate_faces_dropped, duplicate_faces_dropped, vertices_unreferenced,
/// faces_flipped, holes_filled (value = loops; detail with the filled share of the area),
/// components_inverted, non_manifold_edges, components, floating_parts (kept; value = parts that
/// stand apart from the largest; detail with the widest gap).
///
/// What is closed so but still has no outside is wrapped instead (CGAL's alpha wrap, a surface at
/// wrap_offset from all faces) and named by the finding alpha_wrapped (value = alpha [m]; detail
/// with the reason): a surface without a volume, such as a flat sheet, and a one-sided one, such as
/// a Moebius strip. The wrap passes on both sides of a sheet; an input vertex is then mapped to the
/// wrap's nearest vertex that looks to the same side as its faces.
///
/// Source: none in the paper, which assumes a proper mesh (II-A); the wrap is Portaneri et al.,
/// "Alpha wrapping with an offset", 2022.
/// @param soup  vertices [m] and faces in any order and orientation
/// @return kInvalidInput for an empty mesh, a non-finite vertex (its index and value in detail) or
///         an index out of range (face, index, vertex count); kTooLarge for a count over its limit;
///         kDegenerate when nothing with a volume is left, naming why (all faces degenerate, or,
///         when not wrapped, a flat sheet: with its volume ratio)
/// Complexity O(V + F) expected (hashing); a wrap takes 0.1 to 1 s. Pure.
Result<ConditionedMesh> condition_mesh(const TriangleMesh& soup, const ConditionMeshConfig& config);

}  // namespace graspd
