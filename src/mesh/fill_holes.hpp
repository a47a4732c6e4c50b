#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/disjoint_sets.hpp"
#include "graspd/base/geometry.hpp"
#include "mesh_edges.hpp"
#include "orient_faces.hpp"

namespace graspd::mesh_detail {

/// A directed half-edge without an opposite.
struct OpenEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t patch = 0;
};

/// Half-edges without an opposite.
struct OpenEdges {
    std::vector<OpenEdge> edges;
    double seam_m = 0.0;  ///< [m] length of the edges whose two faces are at odds
};

/// Finds the half-edges without an opposite, each as often as it is missing one, and unites the
/// patches that need one another at an edge with more than two faces. At every vertex as many of
/// them end as start, because each face is a directed cycle.
/// @param mesh  as `edges` saw it; open edges run as after turn_faces(patches.flip)
OpenEdges find_open_edges(const TriangleMesh& mesh, const MeshEdges& edges,
                          const Orientation& patches, DisjointSets& groups);

/// Joins open edges to loops that visit no vertex twice: indices into `open`, each edge in one
/// loop. Complexity O(open + V).
std::vector<std::vector<std::uint32_t>> walk_loops(const std::vector<OpenEdge>& open,
                                                   std::size_t vertex_count);

/// What closing the loops added.
struct HoleFill {
    std::uint32_t vertices = 0;
    double area_m2 = 0.0;
};

/// Closes every loop: a single face over three edges, else a fan about the loop's centroid (of the
/// boundary line, so that it does not depend on how finely the line is divided). Appends vertices
/// to `mesh`, faces to `mesh`, their patches to `patch_of_face`, and unites the patches of a loop.
HoleFill fill_holes(const std::vector<OpenEdge>& open,
                    const std::vector<std::vector<std::uint32_t>>& loops, TriangleMesh& mesh,
                    std::vector<std::uint32_t>& patch_of_face, DisjointSets& groups);

}  // namespace graspd::mesh_detail
