#include "graspd/concavity/tetrahedral_concavity.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::run_tetrahedral;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TetrahedralConfig cells_of(double cell_size) {
    TetrahedralConfig config;
    config.cell_size = cell_size;
    return config;
}

/// The field of a mesh that must have one; empty, with a failure, when it has none.
ConcavityField field_of(const TriangleMesh& mesh,
                        const TetrahedralConfig& config = cells_of(0.05)) {
    auto field = run_tetrahedral(mesh, config);
    EXPECT_TRUE(field.ok()) << field.error().detail;
    return field.ok() ? std::move(field).value() : ConcavityField{};
}

/// The error of a mesh that must have one.
PlanError error_of(const TriangleMesh& mesh, const TetrahedralConfig& config = cells_of(0.05)) {
    const auto field = run_tetrahedral(mesh, config);
    EXPECT_FALSE(field.ok());
    return field.ok() ? PlanError{} : field.error();
}

/// Mean and largest difference to the known values, in shares of the greatest one.
struct Errors {
    double mean = 0.0, largest = 0.0;
};

Errors errors_of(const test::ConcavityAnswer& answer, const ConcavityField& field) {
    Errors errors;
    double greatest = 0.0;
    for (std::size_t v = 0; v < field.value_m.size(); ++v) {
        const double expected = answer.value_m(answer.mesh.vertices[v]);
        const double error = std::abs(field.value_m[v] - expected);
        errors.mean += error / static_cast<double>(field.value_m.size());
        errors.largest = std::isfinite(error) ? std::max(errors.largest, error) : kInfinity;
        greatest = std::max(greatest, expected);
    }
    return {errors.mean / greatest, errors.largest / greatest};
}

class TetrahedralConcavityOf : public testing::TestWithParam<const char*> {};

// Cells of h, h/2, h/4 in a turned object: the mean error falls each time, to a thousandth of the
// greatest value; the largest one never rises and ends lower than it began.
TEST_P(TetrahedralConcavityOf, ErrorFallsWithTheCells) {
    const auto answers = test::straight_answers(3000);
    const auto answer = std::ranges::find(answers, GetParam(), &test::ConcavityAnswer::name);
    ASSERT_NE(answer, answers.end());
    const TriangleMesh mesh = test::moved(answer->mesh, test::random_pose(21));
    std::vector<Errors> errors;
    for (const double cell_size : {0.05, 0.025, 0.0125}) {
        errors.push_back(errors_of(*answer, field_of(mesh, cells_of(cell_size))));
    }
    EXPECT_LT(errors[1].mean, errors[0].mean);
    EXPECT_LT(errors[2].mean, errors[1].mean);
    EXPECT_LT(errors[2].mean, 1e-3);
    EXPECT_LE(errors[1].largest, errors[0].largest);
    EXPECT_LE(errors[2].largest, errors[1].largest);
    EXPECT_LT(errors[2].largest, errors[0].largest);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TetrahedralConcavityOf, testing::Values("cup", "bowl", "channel"),
                         [](const auto& shape) { return std::string(shape.param); });

// A ball hangs free over a cup's floor, its middle m above it. From the floor's middle the shortest
// way touches the ball, follows it up to its greatest width and leaves straight up: sqrt(m^2 - r^2)
// + r asin(r / m) + the rest of the height.
TEST(TetrahedralConcavity, GoesRoundAPieceInTheHollow) {
    constexpr double kRadius = 0.015, kMiddle = 0.036, kRest = 0.05;
    Eigen::Isometry3d lift = Eigen::Isometry3d::Identity();
    lift.translation().z() = 0.04;
    const TriangleMesh mesh = test::joined(test::cup(0.04, 0.09, 0.004, 1500),
                                           test::moved(test::sphere(kRadius, 600), lift));
    const ConcavityField field =
        field_of(test::moved(mesh, test::random_pose(32)), cells_of(0.0125));
    const Vector3d floor(0.0, 0.0, 0.004);
    const auto v = std::ranges::find_if(
        mesh.vertices, [&](const Vector3d& p) { return (p - floor).norm() < 1e-9; });
    ASSERT_NE(v, mesh.vertices.end());
    const double way = std::sqrt(kMiddle * kMiddle - kRadius * kRadius) +
                       kRadius * std::asin(kRadius / kMiddle) + kRest;
    EXPECT_NEAR(field.value_m.at(v - mesh.vertices.begin()), way, 0.015 * way);
}

// A convex body lies on its hull: exactly 0 everywhere, in any pose.
TEST(TetrahedralConcavity, IsZeroOnTheHull) {
    for (const TriangleMesh& body : {test::box({0.1, 0.2, 0.3}, 300), test::sphere(0.05, 800)}) {
        const ConcavityField field = field_of(test::moved(body, test::random_pose(3)));
        EXPECT_THAT(field.value_m, testing::Each(0.0));
        EXPECT_THAT(field.flag, testing::Each(ConcavityFlag::kPath));
        EXPECT_EQ(field.largest_m, 0.0);
    }
}

// Where top and end of a channel's hull meet, a tetrahedron with corners on both cuts that edge
// off. Its face is no part of the hull: a front that started on it would be up to 1 - 1/sqrt(2)
// short.
TEST(TetrahedralConcavity, StartsOnFacetsNotAcrossTheirEdges) {
    const auto answers = test::straight_answers(5000);
    const auto channel = std::ranges::find(answers, "channel", &test::ConcavityAnswer::name);
    ASSERT_NE(channel, answers.end());
    const ConcavityField field = field_of(test::moved(channel->mesh, test::random_pose(5)));
    ASSERT_EQ(field.value_m.size(), channel->mesh.vertices.size());
    for (std::size_t v = 0; v < field.value_m.size(); ++v) {
        EXPECT_GE(field.value_m[v], 0.8 * channel->value_m(channel->mesh.vertices[v]));
    }
}

// A hollow 1 mm deep and 50 mm wide, cells of 6 mm: the way out is straight up, not to the rim.
TEST(TetrahedralConcavity, LeavesAShallowHollowStraight) {
    const TriangleMesh block = test::blind_hole_block({0.08, 0.08, 0.03}, 0.05, 0.001, 2000);
    const ConcavityField field = field_of(test::moved(block, test::random_pose(6)));
    ASSERT_EQ(field.value_m.size(), block.vertices.size());
    int floor = 0;
    for (std::size_t v = 0; v < block.vertices.size(); ++v) {
        if (std::abs(block.vertices[v].z() + 0.001) > 1e-9) continue;
        if (block.vertices[v].head<2>().cwiseAbs().maxCoeff() > 0.02) continue;
        ++floor;
        EXPECT_NEAR(field.value_m[v], 0.001, 1e-4);
    }
    EXPECT_GT(floor, 20);
}

// A wall a tenth of a cell thick holds the front back: the floor of a cup 0.08 deep is 0.08 off,
// not the thickness of its bottom.
TEST(TetrahedralConcavity, DoesNotLeakThroughAThinWall) {
    const TriangleMesh cup = test::cup(0.04, 0.0805, 0.0005, 1500);
    const ConcavityField field = field_of(test::moved(cup, test::random_pose(8)));
    ASSERT_EQ(field.value_m.size(), cup.vertices.size());
    int floor = 0;
    for (std::size_t v = 0; v < cup.vertices.size(); ++v) {
        const Vector3d& p = cup.vertices[v];
        if (std::abs(p.z() - 0.0005) > 1e-9) continue;
        ++floor;
        EXPECT_NEAR(field.value_m[v], 0.08, 0.03 * 0.08);
    }
    EXPECT_GT(floor, 20);
    EXPECT_NEAR(field.largest_m, 0.08, 0.03 * 0.08);
}

// A box in a box in a box: no way out of the inner ones, whichever way they are wound. A vertex
// that no face uses has no value. None has a way to show.
TEST(TetrahedralConcavity, EnclosedIsInfiniteAndUnreferencedNan) {
    const TriangleMesh outside = test::box({0.1, 0.1, 0.1}, 300);
    const TriangleMesh hollow = test::box({0.08, 0.08, 0.08}, 200);
    for (const TriangleMesh& inside : {hollow, test::inside_out(hollow)}) {
        TriangleMesh mesh =
            test::joined(test::joined(outside, inside), test::box({0.02, 0.02, 0.02}, 12));
        const std::size_t used = mesh.vertices.size();
        mesh.vertices.emplace_back(0.0, 0.0, 0.03);
        const ConcavityField field = field_of(mesh);
        const auto hull = outer_hull(mesh.vertices);
        ASSERT_EQ(field.value_m.size(), used + 1);
        for (std::uint32_t v = 0; v < used; ++v) {
            const bool out = v < outside.vertices.size();
            EXPECT_EQ(field.value_m[v], out ? 0.0 : kInfinity);
            EXPECT_EQ(field.flag[v], out ? ConcavityFlag::kPath : ConcavityFlag::kEnclosed);
            EXPECT_TRUE(escape_path(mesh, hull.value(), field, v).empty());
        }
        EXPECT_TRUE(std::isnan(field.value_m[used]));
        EXPECT_EQ(field.flag[used], ConcavityFlag::kUnreferenced);
        EXPECT_EQ(field.largest_m, 0.0);
    }
}

// Values without a way: the path is empty for every vertex of a cup.
TEST(TetrahedralConcavity, HasNoEscapePaths) {
    const TriangleMesh mesh = test::cup(0.04, 0.09, 0.004, 600);
    const ConcavityField field = field_of(mesh);
    const auto hull = outer_hull(mesh.vertices);
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        EXPECT_TRUE(escape_path(mesh, hull.value(), field, v).empty());
    }
}

// Two bars that cross: no number of splits makes the faces fit.
TEST(TetrahedralConcavity, RefusesAMeshThatIntersectsItself) {
    const PlanError error = error_of(
        test::joined(test::box({0.3, 0.04, 0.04}, 100), test::box({0.04, 0.3, 0.03}, 100)));
    EXPECT_EQ(error.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error.detail,
                testing::ContainsRegex("[0-9]+ of [0-9]+ pieces of the surface are no "
                                       "faces of tetrahedra after [0-9]+ rounds"));
    EXPECT_THAT(error.detail, HasSubstr("intersects itself"));
}

// Nothing to split with: the same reason, at once.
TEST(TetrahedralConcavity, RefusesWhatTheRoundsDoNotMend) {
    TetrahedralConfig config = cells_of(0.05);
    config.max_split_rounds = 0;
    const PlanError error = error_of(test::cup(0.04, 0.09, 0.004, 1000), config);
    EXPECT_EQ(error.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error.detail, HasSubstr("after 0 rounds of splitting (max_split_rounds = 0)"));
}

// Through a hole in the floor of a cup the front would come behind the walls.
TEST(TetrahedralConcavity, RefusesAMeshThatLeaks) {
    const TriangleMesh cup = test::cup(0.04, 0.09, 0.004, 1000);
    std::vector<std::size_t> floor;
    for (std::size_t f = 0; f < cup.faces.size() && floor.empty(); ++f) {
        const auto on_floor = [&](std::uint32_t v) {
            return std::abs(cup.vertices[v].z() - 0.004) < 1e-9;
        };
        if (std::ranges::all_of(cup.faces[f], on_floor)) floor.push_back(f);
    }
    ASSERT_EQ(floor.size(), 1u);
    for (const TriangleMesh& mesh : {test::without(cup, floor), test::inside_out(cup)}) {
        const PlanError error = error_of(mesh);
        EXPECT_EQ(error.code, PlanErrorCode::kInvalidInput);
        EXPECT_THAT(error.detail, testing::ContainsRegex("[0-9]+ of [0-9]+ pieces of the surface "
                                                         "are reached from behind"));
    }
}

TEST(TetrahedralConcavity, LimitsAreNamedWithTheirValue) {
    const TriangleMesh mesh = test::cup(0.04, 0.09, 0.004, 1000);
    TetrahedralConfig few = cells_of(0.05);
    few.max_cells = 1000;  // the 1000 faces alone take more
    TetrahedralConfig fine = cells_of(0.002);
    fine.max_cells = 20000;  // and the points of a fine grid, before any is inserted
    for (const TetrahedralConfig& config : {few, fine}) {
        const PlanError error = error_of(mesh, config);
        EXPECT_EQ(error.code, PlanErrorCode::kTooLarge);
        EXPECT_THAT(error.detail, HasSubstr("tetrahedral_concavity.max_cells = " +
                                            std::to_string(config.max_cells) + " is passed"));
    }
    TetrahedralConfig soon = cells_of(0.003);
    soon.max_time_ms = 20.0;
    const PlanError late = error_of(mesh, soon);
    EXPECT_EQ(late.code, PlanErrorCode::kTooLarge);
    EXPECT_THAT(late.detail, AllOf(HasSubstr("tetrahedral_concavity.max_time_ms = 20 is passed"),
                                   HasSubstr("cell_size = 0.003")));
}

TEST(TetrahedralConcavity, RefusesBadSettingsAndEmptyInput) {
    const TriangleMesh mesh = test::box({1, 1, 1}, 12);
    const PlanError range = error_of(mesh, cells_of(0.7));
    EXPECT_EQ(range.code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(range.detail, HasSubstr("tetrahedral_concavity.cell_size = 0.7 is outside"));
    const TriangleBvh bvh(mesh, 1e-6);
    const auto no_hull = tetrahedral_concavity(mesh, {}, bvh, {});
    ASSERT_FALSE(no_hull.ok());
    EXPECT_EQ(no_hull.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(no_hull.error().detail, HasSubstr("12 faces and 0 hull facets"));
}

// The same mesh gives the same bytes; another seed moves the grid and so the values a little.
TEST(TetrahedralConcavity, IsRepeatable) {
    const TriangleMesh mesh =
        test::moved(test::hourglass(0.04, 0.01, 0.05, 0.015, 1500), test::random_pose(3));
    TetrahedralConfig config = cells_of(0.04);
    const ConcavityField first = field_of(mesh, config), second = field_of(mesh, config);
    EXPECT_EQ(first.value_m, second.value_m);
    config.seed = 2;
    EXPECT_NE(first.value_m, field_of(mesh, config).value_m);
}

}  // namespace
}  // namespace graspd
