#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd::mesh_detail {

/// A closed surface around a soup, and where the soup's vertices went.
struct AlphaWrap {
    TriangleMesh mesh;                             ///< [m] closed, two-manifold
    std::vector<std::uint32_t> nearest_of_vertex;  ///< per soup vertex: index in mesh.vertices
    double alpha_m = 0.0;                          ///< [m] hollows with narrower mouths are closed
    double offset_m = 0.0;                         ///< [m] the surface runs so far off the soup
};

/// Wraps a soup from outside (Portaneri et al. 2022, as CGAL's alpha_wrap_3). The surface keeps a
/// distance, so it passes on both sides of an open sheet; the vertices of such a sheet go to the
/// side that their faces look to.
///
/// @param soup    [m] finite, all vertices in use, of an extent that can be squared
/// @param alpha   [1] of the soup's diagonal
/// @param offset  [1] of the soup's diagonal
/// @return kDegenerate when nothing can be wrapped (all faces without area), naming why
/// Complexity at most O(alpha^-3) triangles, O(F log F) to build the search tree; same input, same
/// bytes. Pure.
Result<AlphaWrap> alpha_wrap(const TriangleMesh& soup, double alpha, double offset);

}  // namespace graspd::mesh_detail
