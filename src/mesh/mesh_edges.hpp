#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

// Half-edge h = 3f + k runs from corner k of face f to corner k + 1.

/// First vertex of a half-edge.
inline std::uint32_t tail_of(const std::vector<Triangle>& faces, std::uint32_t half) {
    return faces[half / 3][half % 3];
}
/// Last vertex of a half-edge.
inline std::uint32_t head_of(const std::vector<Triangle>& faces, std::uint32_t half) {
    return faces[half / 3][(half % 3 + 1) % 3];
}
/// Whether a half-edge runs from the lower to the higher vertex index.
inline bool rises(const std::vector<Triangle>& faces, std::uint32_t half) {
    return tail_of(faces, half) < head_of(faces, half);
}

/// An undirected edge.
struct MeshEdge {
    std::uint32_t low = 0;       ///< lower vertex index
    std::uint32_t high = 0;      ///< higher vertex index
    std::uint32_t half[2] = {};  ///< the first two half-edges on it
    std::uint32_t count = 0;     ///< half-edges on it: 2 on a manifold, 1 at a boundary
};

/// The undirected edges of a face list, in order of their first half-edge.
struct MeshEdges {
    std::vector<MeshEdge> edges;
    std::vector<std::uint32_t> edge_of_half;  ///< (3 F)
};

/// Collects the edges. No face may repeat a vertex. Complexity O(F) expected.
MeshEdges collect_edges(const std::vector<Triangle>& faces);

}  // namespace graspd::mesh_detail
