#pragma once

#include <cstddef>
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

/// A half-edge on an edge with more than two faces.
struct CrowdedHalf {
    std::uint32_t edge = 0;  ///< the lowest half-edge on the same edge
    std::uint32_t half = 0;

    auto operator<=>(const CrowdedHalf&) const = default;
};

/// What lies on the other side of every half-edge.
struct MeshEdges {
    /// (3 F) on an edge with two faces the other half-edge, on one with a single face the half-edge
    /// itself, on one with more kNone (hash_bits.hpp)
    std::vector<std::uint32_t> across;
    std::vector<CrowdedHalf> crowded;  ///< all of them; those of an edge in rising order
    std::size_t crowded_edges = 0;     ///< edges with more than two faces
    std::size_t open_edges = 0;        ///< edges with a single face
    bool at_odds = false;              ///< some two faces run along an edge in the same direction
};

/// Collects the edges. No face may repeat a vertex. Complexity O(V + F).
MeshEdges collect_edges(const std::vector<Triangle>& faces, std::size_t vertex_count);

}  // namespace graspd::mesh_detail
