#pragma once

#include <vector>

#include "graspd/concavity/outer_hull.hpp"
#include "support/exact_surface.hpp"

namespace graspd::test {

/// Concavity by brute force: length of the shortest way to the hull that bends at vertices alone
/// [m], infinite where there is none.
///
/// Every vertex starts from the nearest hull plane whose perpendicular is free. Then Dijkstra over
/// all pairs of vertices, joined where exact predicates find the segment between the lifted
/// vertices free. Nothing is guessed or left out, and a pair is tested only when it would shorten.
/// An upper bound of the true value, which may bend inside edges too.
/// @param surface  of the same mesh
/// Cost O(V^2) distances and as many exact tests at worst.
std::vector<double> visibility_graph_m(const TriangleMesh& mesh, const OuterHull& hull,
                                       const ExactSurface& surface);

}  // namespace graspd::test
