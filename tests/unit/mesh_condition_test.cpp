#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "graspd/mesh/condition_mesh.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using test::box;
using testing::HasSubstr;

double value_of(const ConditionedMesh& result, const std::string& code) {
    for (const Finding& finding : result.findings) {
        if (finding.code == code) return finding.value;
    }
    return 0.0;
}

ConditionedMesh conditioned(const TriangleMesh& soup) {
    Result<ConditionedMesh> result = condition_mesh(soup, {});
    EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().detail);
    return result.ok() ? std::move(result).value() : ConditionedMesh{};
}

PlanError error_of(const TriangleMesh& soup, const ConditionMeshConfig& config = {}) {
    const Result<ConditionedMesh> result = condition_mesh(soup, config);
    EXPECT_FALSE(result.ok());
    return result.ok() ? PlanError{} : result.error();
}

// A proper mesh comes out as it went in: same vertices in the same order, same faces, and the only
// finding is that it is one piece.
TEST(ConditionMesh, LeavesAProperMeshAlone) {
    const TriangleMesh mesh = test::cup(0.04, 0.09, 0.004, 2000);
    const ConditionedMesh result = conditioned(mesh);
    EXPECT_EQ(result.mesh.vertices, mesh.vertices);
    EXPECT_EQ(result.mesh.faces, mesh.faces);
    EXPECT_EQ(result.fill_vertices, 0u);
    ASSERT_EQ(result.findings.size(), 1u);
    EXPECT_EQ(result.findings[0].code, "components");
    EXPECT_EQ(result.findings[0].value, 1.0);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        EXPECT_EQ(result.vertex_of_input[i], static_cast<std::int32_t>(i));
    }
}

// Volume 2 x 3 x 5 cm and centre at the box's middle, also 10 m from the origin, where a plain sum
// of tetrahedra against the origin would lose half of the digits.
TEST(ConditionMesh, VolumeAndCentreOfABox) {
    Eigen::Isometry3d pose = test::random_pose(7);
    pose.pretranslate(Eigen::Vector3d(10, -20, 30));
    const ConditionedMesh result = conditioned(test::moved(box({0.02, 0.03, 0.05}, 300), pose));
    EXPECT_NEAR(result.volume_m3, 30e-6, 1e-15);
    EXPECT_LT((result.center_of_mass - pose.translation()).norm(), 1e-12);
}

// L of two bars, 5 x 1 and 1 x 7 square units (here cm) after the shared corner is given to the
// first: centroid x = (6 * 3 + 7 * 0.5) / 13, z = (6 * 0.5 + 7 * 4.5) / 13 with the first bar 6 x 1
// at z in [0, 1], the second 1 x 7 at z in [1, 8].
TEST(ConditionMesh, CentreOfAnL) {
    const ConditionedMesh result = conditioned(test::l_shape(0.06, 0.08, 0.01, 0.05, 800));
    EXPECT_NEAR(result.center_of_mass.x(), 0.01 * 21.5 / 13.0, 1e-12);
    EXPECT_NEAR(result.center_of_mass.y(), 0.0, 1e-12);
    EXPECT_NEAR(result.center_of_mass.z(), 0.01 * 34.5 / 13.0, 1e-12);
}

// An STL soup welds back to the mesh that it was made of: one vertex for each distinct point,
// numbered by first appearance, every corner pointing at its place.
TEST(ConditionMesh, WeldsASoup) {
    const TriangleMesh mesh = box({0.02, 0.03, 0.05}, 500);
    const TriangleMesh soup = test::to_soup(mesh);
    const ConditionedMesh result = conditioned(soup);
    EXPECT_EQ(result.mesh.vertices.size(), mesh.vertices.size());
    EXPECT_EQ(value_of(result, "vertices_welded"),
              static_cast<double>(soup.vertices.size() - mesh.vertices.size()));
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
        EXPECT_EQ(result.mesh.vertices[result.vertex_of_input[i]], soup.vertices[i]);
    }
    EXPECT_TRUE(test::is_closed_manifold(result.mesh));
}

// Copies of a vertex that lie less than the tolerance apart fall together wherever the welding
// grid's walls are; copies ten tolerances apart stay two. 0 welds equal points only, and -0 is 0.
TEST(ConditionMesh, WeldsWithinTheToleranceOnly) {
    const TriangleMesh mesh = box({0.02, 0.03, 0.05}, 500);
    const double tolerance_m = 1e-7 * Eigen::Vector3d(0.02, 0.03, 0.05).norm();
    TriangleMesh soup = test::to_soup(mesh);
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) {  // +-0.3 tolerances along each axis
        for (int axis = 0; axis < 3; ++axis) {
            soup.vertices[i][axis] += (i >> axis & 1 ? 0.25 : -0.25) * tolerance_m;
        }
    }
    EXPECT_EQ(conditioned(soup).mesh.vertices.size(), mesh.vertices.size());
    ConditionMeshConfig exact;
    exact.weld_tolerance = 0.0;
    const auto apart = condition_mesh(soup, exact);
    EXPECT_TRUE(!apart.ok() || apart.value().mesh.vertices.size() > mesh.vertices.size());
    TriangleMesh signed_zero = test::to_soup(mesh);
    for (std::size_t i = 0; i < signed_zero.vertices.size(); i += 2) {
        for (double& value : signed_zero.vertices[i]) value = value == 0.0 ? -0.0 : value;
    }
    const auto welded = condition_mesh(signed_zero, exact);
    ASSERT_TRUE(welded.ok());
    EXPECT_EQ(welded.value().mesh.vertices.size(), mesh.vertices.size());
}

// The same where the walls of the welding grid run elsewhere: some of them part copies of a vertex.
TEST(ConditionMesh, WeldsAcrossTheGridsWalls) {
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(i);
        const TriangleMesh mesh = box({0.02 + 1e-4 * i, 0.03, 0.05}, 500);
        TriangleMesh soup = test::to_soup(mesh);
        for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
            soup.vertices[v].array() += v % 2 ? 1.5e-9 : -1.5e-9;  // of a tolerance of 6e-9
        }
        EXPECT_EQ(conditioned(soup).mesh.vertices.size(), mesh.vertices.size());
    }
}

// Faces with a repeated corner, faces given twice (in any winding) and unused vertices go, and each
// kind is counted.
TEST(ConditionMesh, DropsWhatCarriesNothing) {
    const TriangleMesh mesh = test::sphere(0.05, 800);
    TriangleMesh soup = test::with_duplicates(mesh, test::choose_faces(mesh, 20, 1));
    for (std::size_t f = mesh.faces.size(); f < mesh.faces.size() + 10; ++f) {
        std::swap(soup.faces[f][0], soup.faces[f][1]);
    }
    soup.faces.insert(soup.faces.begin(), {3, 3, 4});
    soup.faces.push_back({5, 6, 5});
    soup.vertices.emplace_back(1, 2, 3);  // far away: must not blow up the welding tolerance
    const ConditionedMesh result = conditioned(soup);
    EXPECT_EQ(result.mesh.faces, mesh.faces);
    EXPECT_EQ(value_of(result, "duplicate_faces_dropped"), 20.0);
    EXPECT_EQ(value_of(result, "degenerate_faces_dropped"), 2.0);
    EXPECT_EQ(value_of(result, "vertices_unreferenced"), 1.0);
    EXPECT_EQ(result.vertex_of_input.back(), -1);
}

// Copies of the three faces around a hole: of each one's edges one has only the two copies on it,
// the others have three faces; whichever corner the faces begin with.
TEST(ConditionMesh, DropsCopiesAtTheRimOfAHole) {
    const TriangleMesh whole = test::sphere(0.05, 800);
    for (std::size_t turn = 0; turn < 3; ++turn) {
        TriangleMesh soup = test::without(whole, {100});
        for (Triangle& face : soup.faces) std::ranges::rotate(face, face.begin() + turn);
        std::vector<std::size_t> rim;
        for (std::size_t f = 0; f < soup.faces.size(); ++f) {
            const auto shared = std::ranges::count_if(soup.faces[f], [&](std::uint32_t v) {
                return std::ranges::count(whole.faces[100], v) != 0;
            });
            if (shared == 2) rim.push_back(f);
        }
        ASSERT_EQ(rim.size(), 3u);
        const ConditionedMesh result = conditioned(test::with_duplicates(soup, rim));
        EXPECT_EQ(value_of(result, "duplicate_faces_dropped"), 3.0);
        EXPECT_EQ(value_of(result, "holes_filled"), 1.0);
        EXPECT_NEAR(result.volume_m3, test::signed_volume_m3(whole), 1e-15);
    }
}

// Any winding in, one winding out: the volume is the shape's, and as many faces are reported as
// were turned (a minority, by the majority's rule).
TEST(ConditionMesh, OrientsFlippedFaces) {
    const TriangleMesh mesh = test::torus(0.05, 0.015, 2000);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const TriangleMesh soup = test::with_flipped(mesh, test::choose_faces(mesh, 300, seed));
        const ConditionedMesh result = conditioned(soup);
        EXPECT_EQ(result.mesh.faces.size(), mesh.faces.size());
        EXPECT_TRUE(test::is_closed_manifold(result.mesh));
        EXPECT_EQ(value_of(result, "faces_flipped"), 300.0);
        EXPECT_NEAR(result.volume_m3, test::signed_volume_m3(mesh), 1e-15);
    }
}

TEST(ConditionMesh, TurnsAnInsideOutMesh) {
    const TriangleMesh mesh = test::cup(0.04, 0.09, 0.004, 2000);
    const ConditionedMesh result = conditioned(test::inside_out(mesh));
    EXPECT_EQ(value_of(result, "components_inverted"), 1.0);
    EXPECT_EQ(value_of(result, "faces_flipped"), 0.0);
    EXPECT_NEAR(result.volume_m3, test::signed_volume_m3(mesh), 1e-15);
}

// Two pieces, one inside out: only that one is turned.
TEST(ConditionMesh, TurnsEachPieceByItself) {
    Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
    aside.translation().x() = 0.2;
    const TriangleMesh first = box({0.02, 0.03, 0.05}, 100);
    const TriangleMesh second = test::inside_out(test::moved(box({0.04, 0.03, 0.05}, 100), aside));
    const ConditionedMesh result = conditioned(test::joined(first, second));
    EXPECT_EQ(value_of(result, "components"), 2.0);
    EXPECT_EQ(value_of(result, "components_inverted"), 1.0);
    EXPECT_NEAR(result.volume_m3, 90e-6, 1e-15);
}

// Two boxes that share an edge: four faces meet in it, and still each box is turned by itself.
TEST(ConditionMesh, TurnsBoxesThatShareAnEdge) {
    Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
    aside.translation() = Eigen::Vector3d(0.02, 0.03, 0.0);
    const TriangleMesh first = box({0.02, 0.03, 0.05}, 12);
    const TriangleMesh soup = test::joined(first, test::inside_out(test::moved(first, aside)));
    const ConditionedMesh result = conditioned(soup);
    EXPECT_EQ(value_of(result, "non_manifold_edges"), 1.0);
    EXPECT_EQ(value_of(result, "components_inverted"), 1.0);
    EXPECT_EQ(value_of(result, "components"), 1.0);
    EXPECT_EQ(value_of(result, "holes_filled"), 0.0);
    EXPECT_NEAR(result.volume_m3, 60e-6, 1e-15);
}

// One face of a closed mesh missing: the hole has three edges and gets a single face, so the mesh
// is whole again without a new vertex.
TEST(ConditionMesh, ClosesATriangularHoleWithOneFace) {
    const TriangleMesh mesh = test::sphere(0.05, 800);
    const ConditionedMesh result = conditioned(test::without(mesh, {100}));
    EXPECT_EQ(result.mesh.faces.size(), mesh.faces.size());
    EXPECT_EQ(result.fill_vertices, 0u);
    EXPECT_EQ(value_of(result, "holes_filled"), 1.0);
    EXPECT_NEAR(result.volume_m3, test::signed_volume_m3(mesh), 1e-15);
    EXPECT_TRUE(test::is_closed_manifold(result.mesh));
}

// A box without its lid: the boundary is the rectangle at the top, whose centroid is the lid's
// middle, so the fan restores the lid's plane and the volume.
TEST(ConditionMesh, ClosesABoxWithoutItsLid) {
    const TriangleMesh whole = box({0.02, 0.03, 0.05}, 400);
    TriangleMesh open = whole;
    std::erase_if(open.faces, [&](const Triangle& face) {
        return std::ranges::all_of(
            face, [&](std::uint32_t v) { return whole.vertices[v].z() > 0.025 - 1e-9; });
    });
    const ConditionedMesh result = conditioned(open);
    EXPECT_EQ(value_of(result, "holes_filled"), 1.0);
    ASSERT_EQ(result.fill_vertices, 1u);
    EXPECT_LT((result.mesh.vertices.back() - Eigen::Vector3d(0, 0, 0.025)).norm(), 1e-12);
    EXPECT_NEAR(result.volume_m3, 30e-6, 1e-15);
    EXPECT_TRUE(test::is_closed_manifold(result.mesh));
}

// Two holes that touch in a vertex are two loops, not one figure of eight: the two faces around a
// vertex that share nothing else are taken away.
TEST(ConditionMesh, WalksHolesThatTouchInAVertex) {
    const TriangleMesh mesh = test::sphere(0.05, 800);
    const std::uint32_t vertex = 200;
    std::vector<std::size_t> around;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (std::ranges::count(mesh.faces[f], vertex)) around.push_back(f);
    }
    const auto share_edge = [&](std::size_t f, std::size_t g) {
        return std::ranges::count_if(mesh.faces[f], [&](std::uint32_t v) {
                   return std::ranges::count(mesh.faces[g], v) != 0;
               }) > 1;
    };
    std::size_t other = 1;
    while (share_edge(around[0], around[other])) ++other;
    const ConditionedMesh result = conditioned(test::without(mesh, {around[0], around[other]}));
    EXPECT_EQ(value_of(result, "holes_filled"), 2.0);
    EXPECT_EQ(result.fill_vertices, 0u);
    EXPECT_NEAR(result.volume_m3, test::signed_volume_m3(mesh), 1e-15);
}

// A strip with one side and one edge.
TriangleMesh moebius_strip() {
    TriangleMesh strip;
    constexpr std::uint32_t kPieces = 30;
    for (std::uint32_t i = 0; i < kPieces; ++i) {
        const double turn = 2.0 * 3.14159265358979 * i / kPieces;
        const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0);
        const Eigen::Vector3d across =
            0.02 * (std::cos(turn / 2) * out + std::sin(turn / 2) * Eigen::Vector3d::UnitZ());
        strip.vertices.push_back(0.1 * out + across);
        strip.vertices.push_back(0.1 * out - across);
    }
    for (std::uint32_t i = 0; i < kPieces; ++i) {
        const bool last = i + 1 == kPieces;
        const std::uint32_t a = 2 * i, b = a + 1;
        const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        strip.faces.push_back({a, b, c});
        strip.faces.push_back({b, d, c});
    }
    return strip;
}

/// A square sheet in the plane z = 0, 0.1 m wide, that looks towards +z.
TriangleMesh flat_sheet(std::uint32_t cells) {
    TriangleMesh sheet;
    for (std::uint32_t i = 0; i <= cells; ++i) {
        for (std::uint32_t j = 0; j <= cells; ++j) {
            sheet.vertices.emplace_back(0.1 * i / cells, 0.1 * j / cells, 0.0);
        }
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
        for (std::uint32_t j = 0; j < cells; ++j) {
            const std::uint32_t a = i * (cells + 1) + j, b = a + cells + 1;
            sheet.faces.push_back({a, b, b + 1});
            sheet.faces.push_back({a, b + 1, a + 1});
        }
    }
    return sheet;
}

// A one-sided strip cannot be oriented, so it is wrapped: closed, with a volume of its area (0.02
// and 0.1 m: some 0.04 x 0.63 m^2) times twice the offset at least. Every vertex goes to one of the
// wrap, not farther away than the wrap's triangles are wide. Without the wrap it comes out
// balanced.
TEST(ConditionMesh, WrapsAMoebiusStrip) {
    const TriangleMesh strip = moebius_strip();
    const ConditionedMesh result = conditioned(strip);
    const double alpha_m = value_of(result, "alpha_wrapped");
    EXPECT_TRUE(result.alpha_wrapped);
    EXPECT_NEAR(alpha_m, 0.03 * 0.33, 0.03 * 0.03);
    ASSERT_FALSE(result.findings.empty());
    EXPECT_THAT(result.findings[0].detail, HasSubstr("one-sided"));
    EXPECT_EQ(value_of(result, "holes_filled"), 0.0);
    EXPECT_EQ(value_of(result, "components"), 1.0);
    EXPECT_TRUE(test::is_closed_manifold(result.mesh));
    EXPECT_GT(result.volume_m3, 2.0 * 0.00033 * 0.025);
    EXPECT_NEAR(result.volume_m3, test::signed_volume_m3(result.mesh), 1e-12);
    for (std::size_t i = 0; i < strip.vertices.size(); ++i) {
        const Eigen::Vector3d& nearest = result.mesh.vertices.at(result.vertex_of_input[i]);
        EXPECT_LT((nearest - strip.vertices[i]).norm(), alpha_m);
    }
    ConditionMeshConfig config;
    config.alpha_wrap = false;
    const auto unwrapped = condition_mesh(strip, config);
    if (unwrapped.ok()) {
        EXPECT_TRUE(test::is_balanced(unwrapped.value().mesh));
        EXPECT_EQ(value_of(unwrapped.value(), "alpha_wrapped"), 0.0);
    }
}

// A flat sheet becomes a plate as thick as twice the offset (1e-3 of the diagonal of 0.1414 m); its
// vertices speak for the side that they look to, so they go to z > 0.
TEST(ConditionMesh, WrapsAFlatSheet) {
    const TriangleMesh sheet = flat_sheet(20);
    const ConditionedMesh result = conditioned(sheet);
    EXPECT_TRUE(result.alpha_wrapped);
    EXPECT_TRUE(test::is_closed_manifold(result.mesh));
    EXPECT_NEAR(result.volume_m3, 0.01 * 2.0 * 1.414e-4, 0.05e-6);
    for (const Eigen::Vector3d& vertex : result.mesh.vertices) {
        EXPECT_LT(std::abs(vertex.z()), 1.5e-4);
    }
    for (std::size_t i = 0; i < sheet.vertices.size(); ++i) {
        const Eigen::Vector3d& nearest = result.mesh.vertices.at(result.vertex_of_input[i]);
        const Eigen::Vector3d& p = sheet.vertices[i];
        EXPECT_LT((nearest - p).norm(), 0.03 * 0.1414) << i;
        const double to_rim = std::min({p.x(), p.y(), 0.1 - p.x(), 0.1 - p.y()});
        EXPECT_TRUE(to_rim < 1e-3 || nearest.z() > 0.0) << i;
    }
    ASSERT_FALSE(result.findings.empty());
    EXPECT_EQ(result.findings[0].code, "alpha_wrapped");
    EXPECT_THAT(result.findings[0].detail, HasSubstr("flat sheet"));
}

// The same wrap again, and the same a thousand times as large and 100 m away.
TEST(ConditionMesh, WrapsAlikeEveryTime) {
    const TriangleMesh strip = moebius_strip();
    const ConditionedMesh once = conditioned(strip), again = conditioned(strip);
    EXPECT_EQ(again.mesh.vertices, once.mesh.vertices);
    EXPECT_EQ(again.mesh.faces, once.mesh.faces);
    EXPECT_EQ(again.vertex_of_input, once.vertex_of_input);
    Eigen::Isometry3d away = Eigen::Isometry3d::Identity();
    away.translation() = Eigen::Vector3d(100, -80, 60);
    const ConditionedMesh large = conditioned(test::moved(test::scaled(strip, 1e3), away));
    EXPECT_NEAR(large.volume_m3, 1e9 * once.volume_m3, 0.02e9 * once.volume_m3);
}

// A coarser wrap has fewer triangles: the count goes with the area over alpha squared.
TEST(ConditionMesh, AlphaBoundsTheWrap) {
    ConditionMeshConfig coarse;
    coarse.wrap_alpha = 0.1;
    const auto result = condition_mesh(moebius_strip(), coarse);
    ASSERT_TRUE(result.ok());
    EXPECT_LT(result.value().mesh.faces.size(), conditioned(moebius_strip()).mesh.faces.size() / 2);
}

// Everything at once, over fixed seeds: balanced on every edge, outward, no vertex unused, every
// input vertex at its place, and the same bytes again.
TEST(ConditionMesh, DamagedMeshesComeOutClosed) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        TriangleMesh soup = test::hourglass(0.04, 0.01, 0.05, 0.015, 1500);
        soup = test::with_flipped(soup, test::choose_faces(soup, 200, seed));
        soup = test::with_duplicates(soup, test::choose_faces(soup, 30, seed + 100));
        soup = test::without(soup, test::choose_faces(soup, 60, seed + 200));
        if (seed % 2) soup = test::to_soup(soup);
        soup = test::moved(test::shuffled(soup, seed), test::random_pose(seed));
        const ConditionedMesh result = conditioned(soup);
        EXPECT_TRUE(test::is_balanced(result.mesh));
        EXPECT_NEAR(test::signed_volume_m3(result.mesh), result.volume_m3, 1e-12);
        EXPECT_NEAR(result.volume_m3, 1.66e-4, 0.1e-4);  // pi (0.04^2 0.03 + 0.01^2 0.05)
        std::vector<char> used(result.mesh.vertices.size(), 0);
        for (const Triangle& face : result.mesh.faces) {
            for (const std::uint32_t v : face) used.at(v) = 1;
        }
        EXPECT_EQ(std::ranges::count(used, 0), 0);
        for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
            const std::int32_t v = result.vertex_of_input[i];
            if (v < 0) continue;
            EXPECT_LT((result.mesh.vertices[v] - soup.vertices[i]).norm(), 1e-7);
        }
        const ConditionedMesh again = conditioned(soup);
        EXPECT_EQ(again.mesh.vertices, result.mesh.vertices);
        EXPECT_EQ(again.mesh.faces, result.mesh.faces);
        EXPECT_EQ(again.center_of_mass, result.center_of_mass);
    }
}

// Conditioning its own result changes nothing but the count of pieces.
TEST(ConditionMesh, IsIdempotent) {
    TriangleMesh soup = test::bowl(0.07, 0.005, 1500);
    soup = test::without(soup, test::choose_faces(soup, 60, 4));
    const ConditionedMesh once = conditioned(soup);
    const ConditionedMesh twice = conditioned(once.mesh);
    EXPECT_EQ(twice.mesh.vertices, once.mesh.vertices);
    EXPECT_EQ(twice.mesh.faces, once.mesh.faces);
}

// --- every error, with the value that a person needs ---

TEST(ConditionMesh, RefusesAnEmptyMesh) {
    EXPECT_EQ(error_of({}).code, PlanErrorCode::kInvalidInput);
    TriangleMesh points;
    points.vertices.emplace_back(0, 0, 0);
    EXPECT_THAT(error_of(points).detail, HasSubstr("1 vertices, 0 faces"));
}

TEST(ConditionMesh, RefusesAVertexThatIsNotFinite) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        TriangleMesh mesh = box({0.02, 0.03, 0.05}, 100);
        mesh.vertices[7].y() = value;
        const PlanError error = error_of(mesh);
        EXPECT_EQ(error.code, PlanErrorCode::kInvalidInput);
        EXPECT_THAT(error.detail, HasSubstr("vertex 7"));
    }
}

TEST(ConditionMesh, RefusesAnIndexOutOfRange) {
    TriangleMesh mesh = box({0.02, 0.03, 0.05}, 12);
    mesh.faces[5][1] = 8;
    const PlanError error = error_of(mesh);
    EXPECT_EQ(error.code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(error.detail, HasSubstr("face 5 uses vertex 8 of 8"));
}

TEST(ConditionMesh, RefusesWhatIsOverItsLimits) {
    const TriangleMesh mesh = box({0.02, 0.03, 0.05}, 12);  // 8 vertices
    ConditionMeshConfig config;
    config.max_vertices = 7;
    EXPECT_EQ(error_of(mesh, config).code, PlanErrorCode::kTooLarge);
    EXPECT_THAT(error_of(mesh, config).detail, HasSubstr("8 vertices"));
    config = {};
    config.max_faces = 11;
    EXPECT_EQ(error_of(mesh, config).code, PlanErrorCode::kTooLarge);
    EXPECT_THAT(error_of(mesh, config).detail, HasSubstr("12 faces"));
}

TEST(ConditionMesh, RefusesAFlatSheetWithItsRatioWhenItMayNotWrap) {
    ConditionMeshConfig config;
    config.alpha_wrap = false;
    TriangleMesh sheet;
    sheet.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}};
    sheet.faces = {{0, 1, 2}, {0, 2, 3}};
    const PlanError error = error_of(sheet, config);
    EXPECT_EQ(error.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error.detail, HasSubstr("flat sheet"));
    // 1 x 1 x 1e-6: volume over the diagonal cubed is 1e-6 / 2.83 = 3.5e-7, below the default 1e-6.
    EXPECT_EQ(error_of(box({0.1, 0.1, 1e-7}, 12), config).code, PlanErrorCode::kDegenerate);
}

// Three corners on a line: there is no area to wrap.
TEST(ConditionMesh, RefusesALine) {
    TriangleMesh line;
    line.vertices = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
    line.faces = {{0, 1, 2}};
    const PlanError error = error_of(line);
    EXPECT_EQ(error.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error.detail, HasSubstr("no face of the mesh has an area"));
}

TEST(ConditionMesh, RefusesFacesThatAreAllDegenerate) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    mesh.faces = {{0, 1, 2}, {1, 1, 0}};
    const PlanError error = error_of(mesh);
    EXPECT_EQ(error.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error.detail, HasSubstr("all 2 faces"));
}

// Coordinates whose squares overflow give an error, not a NaN.
TEST(ConditionMesh, RefusesCoordinatesTooLargeToMeasure) {
    EXPECT_EQ(error_of(test::scaled(box({1, 1, 1}, 12), 1e200)).code, PlanErrorCode::kInvalidInput);
    EXPECT_EQ(error_of(test::scaled(box({1, 1, 1}, 12), 1e120)).code, PlanErrorCode::kDegenerate);
}

TEST(ConditionMesh, RefusesASettingOutOfRange) {
    ConditionMeshConfig config;
    config.weld_tolerance = -1.0;
    EXPECT_THAT(error_of(box({1, 1, 1}, 12), config).detail,
                HasSubstr("condition_mesh.weld_tolerance = -1"));
}

}  // namespace
}  // namespace graspd
