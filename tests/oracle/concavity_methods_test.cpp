#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

// The two methods share the hull and nothing of the search: a front through tetrahedra against rays
// and bends. Where they differ by more than the tetrahedra's first order, one of them is wrong.

constexpr double kCellSize = 0.0125;  // [1] of the diagonal

struct Difference {
    double mean = 0.0;     ///< in shares of the greatest value
    double largest = 0.0;  ///< in cells
};

Difference compare(const TriangleMesh& mesh) {
    const ConcavityField any_angle = test::run_concavity(mesh).field;
    TetrahedralConfig config;
    config.cell_size = kCellSize;
    const auto front = test::run_tetrahedral(mesh, config);
    EXPECT_TRUE(front.ok()) << front.error().detail;
    if (!front.ok()) return {1e9, 1e9};
    Difference difference;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const double apart_m = std::abs(any_angle.value_m[v] - front.value().value_m[v]);
        difference.mean += apart_m / static_cast<double>(mesh.vertices.size());
        difference.largest = std::isfinite(apart_m) ? std::max(difference.largest, apart_m) : 1e9;
    }
    return {difference.mean / any_angle.largest_m,
            difference.largest / (kCellSize * mesh_diagonal_m(mesh))};
}

// Straight ways and bent ones, in a turned pose. Where the hull is near, a way may end at a corner
// of a cell instead of the nearest place: up to a cell's length.
TEST(ConcavityMethods, AgreeWithinTheCells) {
    auto answers = test::straight_answers(2000);
    for (auto& bent : test::bent_answers(2000)) answers.push_back(std::move(bent));
    for (const test::ConcavityAnswer& answer : answers) {
        SCOPED_TRACE(answer.name);
        if (answer.name == "box" || answer.name == "sphere" || answer.name == "wedge") continue;
        const auto difference = compare(test::moved(answer.mesh, test::random_pose(31)));
        EXPECT_LT(difference.mean, 0.01);
        EXPECT_LT(difference.largest, 1.5);
    }
}

// A ball that hangs in a cup's hollow, where no mesh edge leads.
TEST(ConcavityMethods, AgreeOnAPieceInAHollow) {
    Eigen::Isometry3d lift = Eigen::Isometry3d::Identity();
    lift.translation().z() = 0.04;
    const TriangleMesh cup = test::cup(0.04, 0.09, 0.004, 1500);
    const TriangleMesh mesh = test::joined(cup, test::moved(test::sphere(0.015, 600), lift));
    const auto difference = compare(test::moved(mesh, test::random_pose(32)));
    EXPECT_LT(difference.mean, 0.01);
    EXPECT_LT(difference.largest, 1.5);
}

}  // namespace
}  // namespace graspd
