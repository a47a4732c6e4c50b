#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "graspd/mesh/coarsen_mesh.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

std::vector<double> no_weight(const TriangleMesh& mesh) {
    return std::vector<double>(mesh.vertices.size(), 0.0);
}

TEST(CoarsenMesh, FewFacesStayAsTheyAre) {
    const TriangleMesh box = test::box({0.04, 0.06, 0.08});
    const auto coarse = coarsen_mesh(box, no_weight(box), 12);
    ASSERT_TRUE(coarse.ok());
    EXPECT_EQ(coarse.value().mesh.vertices, box.vertices);
    EXPECT_EQ(coarse.value().mesh.faces, box.faces);
    for (std::uint32_t i = 0; i < box.vertices.size(); ++i) {
        EXPECT_EQ(coarse.value().origin.at(i), i);
    }
}

// A square of 4 x 4 vertices 1 m apart, 18 faces, in cells of 2 m: sqrt(2 x 9 m^2 / 4) = 2.12 m
// holds two vertices a side, so four heads are left and the two faces between them.
TEST(CoarsenMesh, ASquareOfFourCellsHasTwoFacesAndItsHeaviestVertices) {
    TriangleMesh square;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) square.vertices.emplace_back(x, y, 0.0);
    }
    for (std::uint32_t y = 0; y < 3; ++y) {
        for (std::uint32_t x = 0; x < 3; ++x) {
            const std::uint32_t a = 4 * y + x;
            square.faces.push_back({a, a + 1, a + 5});
            square.faces.push_back({a, a + 5, a + 4});
        }
    }
    std::vector<double> weight = no_weight(square);
    weight[5] = 1.0;  // in the cell of 0, 1, 2, 4, 5, 6, 8, 9, 10
    weight[4] = std::numeric_limits<double>::infinity();
    const auto coarse = coarsen_mesh(square, weight, 4);
    ASSERT_TRUE(coarse.ok());
    EXPECT_EQ(coarse.value().mesh.faces.size(), 2u);
    const auto& origin = coarse.value().origin;
    EXPECT_EQ((std::set<std::uint32_t>(origin.begin(), origin.end())),
              (std::set<std::uint32_t>{3, 5, 12, 15}));
    for (std::size_t i = 0; i < origin.size(); ++i) {
        EXPECT_EQ(coarse.value().mesh.vertices[i], square.vertices[origin[i]]);
    }
}

// A torus of 70,000 faces keeps its look with 5,000: vertices on it, and its area within a tenth.
TEST(CoarsenMesh, AScanKeepsItsShape) {
    const TriangleMesh torus = test::torus(0.05, 0.015, 70000);
    const auto coarse = coarsen_mesh(torus, no_weight(torus), 5000);
    ASSERT_TRUE(coarse.ok());
    const TriangleMesh& mesh = coarse.value().mesh;
    EXPECT_LE(mesh.faces.size(), 5000u);
    EXPECT_GT(mesh.faces.size(), 2000u);
    double area_m2 = 0.0;
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.vertices.at(face[0]);
        area_m2 +=
            0.5 * (mesh.vertices.at(face[1]) - a).cross(mesh.vertices.at(face[2]) - a).norm();
    }
    const double true_m2 = 4.0 * std::numbers::pi * std::numbers::pi * 0.05 * 0.015;
    EXPECT_NEAR(area_m2, true_m2, 0.1 * true_m2);
}

// A fan of long thin faces from one corner: no cell smaller than all of it would do by itself.
TEST(CoarsenMesh, EndsForEveryMesh) {
    TriangleMesh fan;
    fan.vertices.emplace_back(0.0, 0.0, 0.0);
    for (int i = 0; i < 1000; ++i) fan.vertices.emplace_back(1.0, 0.001 * i, 0.0);
    for (std::uint32_t i = 1; i < 1000; ++i) fan.faces.push_back({0, i, i + 1});
    for (const std::uint32_t most : {1u, 10u, 500u}) {
        const auto coarse = coarsen_mesh(fan, no_weight(fan), most);
        ASSERT_TRUE(coarse.ok());
        EXPECT_LE(coarse.value().mesh.faces.size(), most);
    }
}

TEST(CoarsenMesh, RefusesWhatIsNoMesh) {
    const TriangleMesh box = test::box({0.04, 0.06, 0.08});
    EXPECT_FALSE(coarsen_mesh(box, no_weight(box), 0).ok());
    EXPECT_FALSE(coarsen_mesh(box, std::vector<double>(3), 12).ok());
    TriangleMesh torn = box;
    torn.faces[3][1] = 8;
    const auto refused = coarsen_mesh(torn, no_weight(torn), 4);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, PlanErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace graspd
