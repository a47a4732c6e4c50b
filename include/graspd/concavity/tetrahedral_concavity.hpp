#pragma once

#include <cstdint>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"
#include "graspd/concavity/outer_hull.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"

namespace graspd {

/// Resolution and limits of the tetrahedral method.
struct TetrahedralConfig {
    double cell_size = 0.0125;  ///< [1] of the diagonal: spacing of points in the free space
    std::uint32_t max_cells = 3000000;     ///< more tetrahedra are refused
    std::uint32_t max_split_rounds = 100;  ///< to make the mesh's faces faces of tetrahedra
    double max_time_ms = 60000.0;          ///< [ms] of work after which it is given up
    std::uint64_t seed = 1;                ///< of the points' places

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("cell_size", self.cell_size, 1e-3, 0.5);
        visit("max_cells", self.max_cells, 1u, 100000000u);
        visit("max_split_rounds", self.max_split_rounds, 0u, 1000u);
        visit("max_time_ms", self.max_time_ms, 0.0, 3.6e6);
        visit("seed", self.seed, std::uint64_t{0}, std::uint64_t{1} << 62);
    }
};

/// The vertices' shortest-path concavity by fast marching over tetrahedra, the paper's own way.
///
/// Source: Lei & Wisse 2016, Sec. II-A, Fig. 3d-e; the front's step across one tetrahedron: Sethian
/// and Vladimirsky, Fast methods for the Eikonal equation on unstructured meshes, PNAS 2000.
/// Deviation: CGAL 5.5 has no constrained Delaunay tetrahedra in 3-D. A plain Delaunay
/// tetrahedralisation takes in the vertices, points of a jittered grid between mesh and hull and
/// points on the hull; faces of the mesh that it lacks are cut anew where the mesh is flat, else
/// split at midpoints of edges, until every piece is there. So the cells are no longer than about
/// cell_size wherever the gap is wider, and the error shrinks with it.
///
/// Values carry no way out: reached vertices are flagged kPath without parent (the value is an
/// approximation, not a bound), those on the hull have exactly 0, those that the front does not
/// reach are kEnclosed.
/// @param mesh  closed, outward oriented, free of self-intersections [m]; any frame
/// @param hull  of the mesh's vertices
/// @param bvh   over the same mesh
/// @return kInvalidInput for a setting out of range, when the mesh has no face or the hull no
///         facet, or when the front comes behind faces (mesh open or inside out; counts in detail);
///         kDegenerate when pieces of faces are missing after max_split_rounds (the mesh intersects
///         itself; counts in detail); kTooLarge beyond max_cells or max_time_ms, the one place
///         where the clock counts: it never changes a value
/// Complexity O(N log N) in the points, N ~ gap volume / cell_size^3. Same input, same values.
Result<ConcavityField> tetrahedral_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                             const TriangleBvh& bvh,
                                             const TetrahedralConfig& config);

}  // namespace graspd
