#pragma once

#include <cstdint>
#include <optional>

#include "graspd/base/geometry.hpp"

namespace graspd {

/// Pairs of faces that cross or overlap elsewhere than in a common corner or edge.
struct SelfIntersections {
    std::uint64_t pairs = 0;
    std::uint64_t faces = 0;  ///< that are in some pair
};

/// Counts the pairs by exact predicates (CGAL); faces without area are left out. Not part of a
/// plan: 16,000 faces take about 60 ms, and concavity tests every edge that it runs along anyhow.
///
/// @param mesh        finite [m], indices in range; equal corners welded, else neighbours meet
/// @param most_tests  pairs of faces with overlapping boxes that are looked at
/// @return nothing when there are more of them
/// Complexity O(F log^2 F + tests). The answer depends on the mesh alone.
std::optional<SelfIntersections> count_self_intersections(const TriangleMesh& mesh,
                                                          std::uint64_t most_tests = 5000000);

}  // namespace graspd
