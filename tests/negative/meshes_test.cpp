#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "graspd/mesh/self_intersections.hpp"
#include "negative/verdict.hpp"
#include "support/shapes.hpp"

// Damaged meshes, with counts worked by hand.

namespace graspd::test {
namespace {

using Eigen::Vector3d;
constexpr auto kInvalid = PlanErrorCode::kInvalidInput;
constexpr auto kDegenerate = PlanErrorCode::kDegenerate;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct BadMesh {
    std::string name;
    TriangleMesh mesh;
    Verdict verdict;
};
void PrintTo(const BadMesh& row, std::ostream* out) {
    *out << row.name;
}

/// 12 faces on 8 vertices.
TriangleMesh cube() {
    return box({0.1, 0.1, 0.1});
}
TriangleMesh shifted(TriangleMesh mesh, double x_m) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = x_m;
    return moved(std::move(mesh), pose);
}
TriangleMesh with_vertex(TriangleMesh mesh, const Vector3d& vertex) {
    mesh.vertices.push_back(vertex);
    return mesh;
}
TriangleMesh with_face(TriangleMesh mesh, const Triangle& face) {
    mesh.faces.push_back(face);
    return mesh;
}
TriangleMesh with_coordinate(double value) {
    TriangleMesh mesh = cube();
    mesh.vertices[3].z() = value;
    return mesh;
}
/// A triangle that stands on an edge of the cube: three faces on one edge.
TriangleMesh with_fin() {
    const TriangleMesh whole = cube();
    const Triangle& t = whole.faces[0];
    return with_face(with_vertex(whole, {0, 0, 0.3}), {t[0], t[1], 8});
}
/// A sheet of 0.3 x 0.4 m: its diagonal is 0.5 m, and the wrap's alpha 0.03 of that.
TriangleMesh sheet() {
    return {{{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.4, 0}, {0, 0.4, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}
/// `count` specks of a millimetre, 0.1 m and more beside the cube.
TriangleMesh with_specks(int count) {
    TriangleMesh mesh = cube();
    for (int i = 0; i < count; ++i) {
        mesh = joined(mesh, shifted(box({0.001, 0.001, 0.001}), 0.2 + 0.1 * i));
    }
    return mesh;
}
const BadMesh kRepaired[] = {
    {"Soup", to_soup(cube()), repaired({{"vertices_welded", 28}, {"components", 1}})},
    {"FacesTwice", with_duplicates(cube(), {0, 5, 7}), repaired({{"duplicate_faces_dropped", 3}})},
    {"OneFaceFlipped", with_flipped(cube(), {4}), repaired({{"faces_flipped", 1}})},
    {"ThreeFacesFlipped", with_flipped(cube(), {1, 4, 9}), repaired({{"faces_flipped", 3}})},
    {"InsideOut", inside_out(cube()), repaired({{"components_inverted", 1}})},
    {"OneOfTwoInsideOut", joined(cube(), inside_out(shifted(cube(), 0.5))),
     repaired({{"components_inverted", 1}, {"components", 2}, {"floating_parts", 1}})},
    {"OneFaceMissing", without(cube(), {0}), repaired({{"holes_filled", 1}})},
    {"UnusedVertex", with_vertex(cube(), {1, 1, 1}), repaired({{"vertices_unreferenced", 1}})},
    {"FaceOfTwoCorners", with_face(cube(), {0, 0, 1}), repaired({{"degenerate_faces_dropped", 1}})},
    {"FaceOfOneCorner", with_face(cube(), {2, 2, 2}), repaired({{"degenerate_faces_dropped", 1}})},
    {"Fin", with_fin(), repaired({{"non_manifold_edges", 1}})},
    {"Sheet", sheet(), repaired({{"alpha_wrapped", 0.015, 1e-12}})},
    {"OneTriangle",
     {{{0, 0, 0}, {0.3, 0, 0}, {0, 0.4, 0}}, {{0, 1, 2}}},
     repaired({{"alpha_wrapped", 0.015, 1e-12}})},
    {"Specks", with_specks(3), repaired({{"components", 4}, {"floating_parts", 3}})},
    {"CubesSideBySide", joined(cube(), shifted(cube(), 0.101)), repaired({{"components", 2}})},
    {"EverythingAtOnce",
     with_vertex(with_duplicates(to_soup(with_flipped(cube(), {3})), {2}), {1, 1, 1}),
     repaired({{"vertices_welded", 28},
               {"duplicate_faces_dropped", 1},
               {"faces_flipped", 1},
               {"vertices_unreferenced", 1}})},
};

const BadMesh kRefused[] = {
    {"Nothing", {}, refused(kInvalid, {"mesh is empty: 0 vertices, 0 faces"})},
    {"NoFace", {cube().vertices, {}}, refused(kInvalid, {"8 vertices, 0 faces"})},
    {"NoVertex", {{}, {{0, 1, 2}}}, refused(kInvalid, {"0 vertices, 1 faces"})},
    {"Nan", with_coordinate(kNan), refused(kInvalid, {"mesh vertex 3 = (", "nan) is not finite"})},
    {"Infinite", with_coordinate(-std::numeric_limits<double>::infinity()),
     refused(kInvalid, {"mesh vertex 3 = (", "-inf) is not finite"})},
    {"NanInAnUnusedVertex", with_vertex(cube(), {0, kNan, 0}),
     refused(kInvalid, {"mesh vertex 8 = (0, nan, 0)"})},
    {"NoSuchVertex", with_face(cube(), {0, 1, 8}),
     refused(kInvalid, {"mesh face 12 uses vertex 8 of 8"})},
    {"HugeIndex", with_face(cube(), {0, 4294967295u, 1}),
     refused(kInvalid, {"uses vertex 4294967295 of 8"})},
    {"AllFacesOfTwoCorners",
     {cube().vertices, {{0, 0, 1}, {2, 3, 3}}},
     refused(kDegenerate, {"all 2 faces of the mesh are degenerate"})},
    {"Line",
     {{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1, 2}}},
     refused(kDegenerate, {"no face of the mesh has an area"})},
    {"SquaresOverflow", scaled(cube(), 1e200),
     refused(kInvalid, {"bounding box is too large to measure"})},
    {"CubesOverflow", scaled(cube(), 1e121), refused(kDegenerate, {"volume"})},
    {"CubesUnderflow", scaled(cube(), 1e-120), refused(kDegenerate, {"volume"})},
};

class Meshes : public testing::TestWithParam<BadMesh> {};

TEST_P(Meshes, GetTheirVerdict) {
    expect_verdict(close(GetParam().mesh), GetParam().verdict);
}

INSTANTIATE_TEST_SUITE_P(Repaired, Meshes, testing::ValuesIn(kRepaired), kName);
INSTANTIATE_TEST_SUITE_P(Refused, Meshes, testing::ValuesIn(kRefused), kName);

// --- parts that stand apart ---

// A millimetre beside a cube of 0.1 m is below 1 % of the diagonal; what lies within the largest
// part is its hollow or its core; and what passes through it, with all corners far off, meets it.
TEST(FloatingParts, NotWhatIsCloseNorWhatIsWithin) {
    const TriangleMesh within = box({0.05, 0.05, 0.05});
    for (const TriangleMesh& mesh :
         {joined(cube(), shifted(cube(), 0.101)), joined(cube(), within),
          joined(cube(), inside_out(within)), joined(cube(), shifted(within, 0.05)),
          joined(cube(), box({0.5, 0.01, 0.01}))}) {
        const Outcome outcome = close(mesh);
        EXPECT_FALSE(outcome.error.has_value());
        EXPECT_EQ(std::ranges::count(outcome.findings, "floating_parts", &Finding::code), 0);
        EXPECT_EQ(std::ranges::count(outcome.findings, "components", &Finding::code), 1);
    }
}

// Two specks of 1 mm at 0.1 m from the cube's side x = 0.05: the gaps are 149.5 and 249.5 mm, the
// area of one is 6e-6 of 0.060012 m2.
TEST(FloatingParts, GapAndShareAreTold) {
    const Outcome outcome = close(with_specks(2));
    const auto found = std::ranges::find(outcome.findings, "floating_parts", &Finding::code);
    ASSERT_NE(found, outcome.findings.end());
    for (const char* part : {"2 of 3 parts", "widest gap 0.2495 m", "0.009998 %"}) {
        EXPECT_NE(found->detail.find(part), std::string::npos) << found->detail;
    }
}

// --- faces that cross each other ---

std::uint64_t crossings(const TriangleMesh& mesh) {
    const auto counted = count_self_intersections(mesh);
    EXPECT_TRUE(counted.has_value());
    return counted ? counted->pairs : 0;
}

// Corners and edges in common are no crossing, nor are faces that only lie near each other.
TEST(SelfIntersections, AProperMeshHasNone) {
    for (const TriangleMesh& mesh : {cube(), torus(0.06, 0.02, 2000), cup(0.04, 0.1, 0.003)}) {
        EXPECT_EQ(crossings(moved(mesh, random_pose(2))), 0u);
    }
    EXPECT_EQ(crossings(joined(cube(), shifted(cube(), 0.101))), 0u);
}

// A needle through two opposite sides of the cube, each of two triangles, away from their common
// diagonal: each of the needle's three long sides, of two triangles that both span its length,
// crosses one triangle of each side. 3 x 2 x 2 pairs.
TEST(SelfIntersections, CountsPairsOfFaces) {
    TriangleMesh needle;
    const double y[3] = {0.020, 0.024, 0.020}, z[3] = {-0.010, -0.010, -0.006};
    for (const double x : {-0.2, 0.2}) {
        for (std::size_t i = 0; i < 3; ++i) needle.vertices.emplace_back(x, y[i], z[i]);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t j = (i + 1) % 3;
        needle.faces.push_back({i, j, j + 3});
        needle.faces.push_back({i, j + 3, i + 3});
    }
    EXPECT_EQ(crossings(joined(cube(), needle)), 12u);
    EXPECT_EQ(count_self_intersections(joined(cube(), needle))->faces, 6u + 2u);
}

// Two triangles over a common edge, unfolded, then folded flat onto each other.
TEST(SelfIntersections, FoldedFlat) {
    TriangleMesh pair{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
    EXPECT_EQ(crossings(pair), 0u);
    pair.vertices[3] = {1, 1, 0};
    EXPECT_EQ(crossings(pair), 1u);
    pair.vertices[3] = {1, 1, 1e-9};  // exact predicates see the gap
    EXPECT_EQ(crossings(pair), 0u);
}

// One common corner: the far side of the one goes through the other, or passes beside it.
TEST(SelfIntersections, AboutACommonCorner) {
    TriangleMesh pair{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}},
                      {{0, 1, 2}, {0, 3, 4}}};
    EXPECT_EQ(crossings(pair), 1u);
    pair.vertices[4] = {0.3, 0.3, 0.5};
    EXPECT_EQ(crossings(pair), 0u);
}

TEST(SelfIntersections, WorkIsBounded) {
    EXPECT_FALSE(count_self_intersections(torus(0.06, 0.02, 2000), 100).has_value());
}

}  // namespace
}  // namespace graspd::test
