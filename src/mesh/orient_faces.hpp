#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "mesh_edges.hpp"

namespace graspd::mesh_detail {

/// Faces in patches that hang together over two-manifold edges.
struct Orientation {
    std::vector<std::uint32_t> patch_of_face;
    std::uint32_t patches = 0;
    std::uint32_t flipped = 0;  ///< faces that must be turned round to agree with their patch
    std::vector<char> flip;     ///< per face: 1 when it is one of them
};

/// Makes neighbours agree over every edge that has exactly two faces. A patch keeps the sense of
/// its majority (of its first face when even). On a one-sided patch (a Moebius strip) some edges
/// stay at odds.
/// Complexity O(F).
Orientation orient_faces(const std::vector<Triangle>& faces, const MeshEdges& edges);

/// Turns the marked faces round: (a, b, c) becomes (a, c, b).
void turn_faces(const std::vector<char>& flip, std::vector<Triangle>& faces);

}  // namespace graspd::mesh_detail
