#include "fast_marching.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "split_surface.hpp"
#include "support/shapes.hpp"

namespace graspd::concavity_detail {
namespace {

using Eigen::Vector3d;

/// The triangle (0,0,0), (4,0,0), (0,4,0) as source, and a tetrahedron to one point above it.
double value_above_triangle(const Vector3d& apex, const std::vector<char>& is_source,
                            const std::unordered_set<std::uint64_t>& chords = {}) {
    const Tetrahedra space{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, apex}, {{0, 1, 2, 3}}};
    return march_front(space, {is_source, chords})[3];
}

// Over the triangle's inside the front comes straight up; beyond an edge or a corner it comes from
// there: 3-4-5 and 1-2-2-3 triangles by hand.
TEST(MarchFront, ComesFromTheNearestPointOfAFace) {
    EXPECT_NEAR(value_above_triangle({1, 1, 2}, {1, 1, 1, 0}), 2.0, 1e-14);
    EXPECT_NEAR(value_above_triangle({2, -3, 4}, {1, 1, 1, 0}), 5.0, 1e-14);
    EXPECT_NEAR(value_above_triangle({-1, -2, 2}, {1, 1, 1, 0}), 3.0, 1e-14);
}

// With the edge from corner 1 to 2 as the only source the nearest point is that edge's middle; the
// third corner, 2 sqrt 2 away, is no help.
TEST(MarchFront, ComesFromAnEdge) {
    EXPECT_NEAR(value_above_triangle({2, 2, 3}, {0, 1, 1, 0}), 3.0, 1e-14);
}

// Sources at both ends of a chord, but not along it: only its ends count, sqrt(8 + 9) away.
TEST(MarchFront, DoesNotStartOnAChord) {
    EXPECT_NEAR(value_above_triangle({2, 2, 3}, {0, 1, 1, 0}, {edge_key(2, 1)}), std::sqrt(17.0),
                1e-14);
    // Off the triangle's inside, with one of its edges a chord: the nearest edge that is none.
    EXPECT_NEAR(value_above_triangle({1, 1, 2}, {1, 1, 1, 0}, {edge_key(1, 2)}), std::sqrt(5.0),
                1e-14);
}

// Past the end of a bar of tetrahedra, and what no tetrahedron joins to a source.
TEST(MarchFront, IsInfiniteWhereNoWayLeads) {
    const Tetrahedra space{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 0, 0}, {8, 0, 0}, {9, 1, 0}, {9, 0, 1}},
        {{0, 1, 2, 3}, {4, 5, 6, 7}}};
    const auto value = march_front(space, {{1, 0, 0, 0, 0, 0, 0, 0}, {}});
    EXPECT_NEAR(value[3], 1.0, 1e-15);
    for (std::size_t p = 4; p < 8; ++p) {
        EXPECT_EQ(value[p], std::numeric_limits<double>::infinity());
    }
}

// Splitting and turning keep a closed surface closed, of the same volume.
TEST(SplitSurface, StaysTheSameSurface) {
    TriangleMesh mesh = test::cup(0.4, 0.9, 0.05, 400);
    const double volume = test::signed_volume_m3(mesh);
    const std::size_t faces = mesh.faces.size();
    SplitSurface surface(mesh.faces);
    ASSERT_TRUE(surface.split_long_edges(0.1, 100000, mesh.vertices));
    const std::size_t split = surface.pieces().size();
    EXPECT_GT(split, faces);
    std::vector<std::size_t> every(split);
    for (std::size_t i = 0; i < split; ++i) every[i] = i;
    const auto prefers_even = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 2 == 0; };
    EXPECT_GT(surface.flip_flat(every, prefers_even, mesh.vertices), 10u);
    mesh.faces = surface.pieces();
    EXPECT_EQ(mesh.faces.size(), split);
    EXPECT_TRUE(test::is_closed_manifold(mesh));
    EXPECT_NEAR(test::signed_volume_m3(mesh), volume, 1e-9 * volume);
    for (const Triangle& piece : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d side = mesh.vertices[piece[k]] - mesh.vertices[piece[(k + 1) % 3]];
            EXPECT_LT(side.norm(), 0.2);  // a diagonal of two pieces at most
        }
    }
}

// A roof is not flat: its ridge stays.
TEST(SplitSurface, TurnsNoEdgeThatBends) {
    const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0.5}, {0.5, -1, 0.5}};
    SplitSurface surface({{0, 1, 2}, {1, 0, 3}});
    const auto has_other = [](std::uint32_t a, std::uint32_t b) { return a + b != 1; };
    EXPECT_EQ(surface.flip_flat({0, 1}, has_other, points), 0u);
    std::vector<Vector3d> flat = points;
    for (Vector3d& point : flat) point.z() = 0.0;
    EXPECT_EQ(surface.flip_flat({0, 1}, has_other, flat), 1u);
}

}  // namespace
}  // namespace graspd::concavity_detail
