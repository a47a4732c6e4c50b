#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "mesh_edges.hpp"

namespace graspd::mesh_detail {

/// A face list without repeated corners and repeated faces, on vertices that it all uses.
struct CleanFaces {
    TriangleMesh mesh;
    MeshEdges edges;                            ///< of mesh.faces
    std::vector<std::int32_t> vertex_of_input;  ///< per input vertex, or -1 when no face uses it
    std::uint32_t welded = 0;        ///< input vertices that fell together with an earlier one
    std::uint32_t unreferenced = 0;  ///< input vertices that no kept face uses
    std::uint32_t degenerate = 0;    ///< faces with two equal corners after welding
    std::uint32_t duplicate = 0;     ///< faces with the corners of an earlier face, in any order
};

/// Welds vertices and drops faces that carry nothing. A face of no area whose corners differ stays:
/// without it its neighbours would have a hole.
/// @param soup         [m] finite, indices in range
/// @param in_use       per vertex of the soup: 1 when a face uses it
/// @param tolerance_m  [m] as weld_vertices
/// Complexity O(V + F) expected.
CleanFaces clean_faces(const TriangleMesh& soup, const std::vector<char>& in_use,
                       double tolerance_m);

}  // namespace graspd::mesh_detail
