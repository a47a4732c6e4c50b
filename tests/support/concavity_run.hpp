#pragma once

#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/concavity/tetrahedral_concavity.hpp"

namespace graspd::test {

/// A concavity field and the hull that its paths end on.
struct ConcavityRun {
    OuterHull hull;
    ConcavityField field;
};

/// Hull, tree and concavity of a closed mesh; fails the running test when a stage does.
ConcavityRun run_concavity(const TriangleMesh& mesh, const ConcavityConfig& config = {});

/// The same by the tetrahedral method, whose errors are what some tests are about.
Result<ConcavityField> run_tetrahedral(const TriangleMesh& mesh,
                                       const TetrahedralConfig& config = {});

}  // namespace graspd::test
