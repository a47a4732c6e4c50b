#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

namespace graspd::concavity_detail {

/// A piece of space as tetrahedra.
struct Tetrahedra {
    std::vector<Eigen::Vector3d> points;  ///< any unit
    std::vector<std::array<std::uint32_t, 4>> cells;
};

/// Where a front starts.
struct FrontSources {
    std::vector<char> is_source;  ///< one per point
    /// Edges (edge_key) between two sources that run through the inside: the front does not start
    /// on them, although it does at both their ends.
    std::unordered_set<std::uint64_t> chords;
};

/// The same number for both directions of an edge.
inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

/// Length of the shortest way within the tetrahedra from each point to the sources, first order.
///
/// Source: Sethian and Vladimirsky 2000; Kimmel and Sethian, Computing geodesic paths on manifolds,
/// PNAS 1998. A front that is plane within a tetrahedron passes from its three known corners to the
/// fourth; where its direction does not come through that face, through an edge or a corner of it.
/// A value that is lower than one it came from would not be causal and is not taken.
/// @return one per point, +infinity where no way leads; ties are broken by the lower index
std::vector<double> march_front(const Tetrahedra& space, const FrontSources& sources);

}  // namespace graspd::concavity_detail
