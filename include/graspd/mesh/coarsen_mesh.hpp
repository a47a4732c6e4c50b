#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// A mesh of few faces in place of one of many.
struct CoarseMesh {
    TriangleMesh mesh;                  ///< in the frame of the fine one
    std::vector<std::uint32_t> origin;  ///< per vertex: that vertex of the fine mesh
};

/// Makes a mesh coarse enough to be drawn, for eyes alone: walls thinner than a cell become one.
///
/// All vertices within one cell of a grid become the one of greatest weight (ties: the lowest
/// index), so that what weighs most is still there; faces that lose a side or repeat another one
/// are dropped. The grid's cells grow until the faces are few enough. A mesh of few faces comes
/// back as it is.
///
/// @param mesh       [m] finite vertices
/// @param weight     per vertex; NaN and infinity weigh nothing
/// @param most_faces >= 1
/// @return kInvalidInput for a count of weights that is not that of vertices, an index out of range
///         or most_faces = 0
/// Complexity O((V + F) log(V + F)) a size of cell, of which a few are tried. Pure.
Result<CoarseMesh> coarsen_mesh(const TriangleMesh& mesh, std::span<const double> weight,
                                std::uint32_t most_faces);

}  // namespace graspd
