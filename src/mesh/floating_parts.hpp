#pragma once

#include <optional>

#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

/// Parts of a closed mesh that stand apart from the largest one (by area): pieces without a common
/// vertex, outside it, that it does not cross and whose vertices all keep at least 1 % of the
/// mesh's diagonal from it. A hollow inside the largest part is no part of its own.
///
/// @param mesh  closed, outward, every vertex in use
/// @return the finding floating_parts (value = their count; detail with the widest gap, the least
///         share of the area), nothing when there are none
/// Complexity O(F log F); at most 20000 vertices are measured, evenly chosen.
std::optional<Finding> find_floating_parts(const TriangleMesh& mesh);

}  // namespace graspd::mesh_detail
