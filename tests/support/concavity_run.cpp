#include "support/concavity_run.hpp"

#include <gtest/gtest.h>

namespace graspd::test {

ConcavityRun run_concavity(const TriangleMesh& mesh, const ConcavityConfig& config) {
    auto hull = outer_hull(mesh.vertices);
    EXPECT_TRUE(hull.ok()) << hull.error().detail;
    if (!hull.ok()) return {};
    const TriangleBvh bvh(mesh,
                          mesh_diagonal_m(mesh) * config.start_offset / kOffsetOverRayTolerance);
    auto field = shortest_path_concavity(mesh, hull.value(), bvh, config);
    EXPECT_TRUE(field.ok()) << field.error().detail;
    if (!field.ok()) return {};
    return {std::move(hull).value(), std::move(field).value()};
}

Result<ConcavityField> run_tetrahedral(const TriangleMesh& mesh, const TetrahedralConfig& config) {
    const auto hull = outer_hull(mesh.vertices);
    if (!hull.ok()) return hull.error();
    const TriangleBvh bvh(mesh, 1e-6 * mesh_diagonal_m(mesh));
    return tetrahedral_concavity(mesh, hull.value(), bvh, config);
}

}  // namespace graspd::test
