#include "graspd/concavity/shortest_path_concavity.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graspd/mesh/condition_mesh.hpp"
#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using test::ConcavityRun;
using test::run_concavity;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// As it is; turned; turned and a thousand diagonals away.
std::vector<Eigen::Isometry3d> poses(double diagonal_m) {
    Eigen::Isometry3d far = test::random_pose(12);
    far.pretranslate(1000.0 * diagonal_m * Vector3d(0.6, -0.64, 0.48));
    return {Eigen::Isometry3d::Identity(), test::random_pose(11), far};
}

/// The largest difference to the known values, over those above 5 % of the largest relative, below
/// in shares of that 5 %.
double worst_error(const test::ConcavityAnswer& answer, const ConcavityField& field) {
    double largest = 0.0;
    for (const Vector3d& p : answer.mesh.vertices) {
        largest = std::fmax(largest, answer.value_m(p));  // fmax skips a nan
    }
    double worst = 0.0;
    for (std::size_t v = 0; v < answer.mesh.vertices.size(); ++v) {
        const double expected = answer.value_m(answer.mesh.vertices[v]);
        if (std::isnan(expected)) continue;
        const double scale = std::max({expected, 0.05 * largest, 1e-3});
        const double error = std::abs(field.value_m[v] - expected) / scale;
        worst = std::isfinite(error) ? std::max(worst, error) : kInfinity;
    }
    return worst;
}

class ConcavityOfSize : public testing::TestWithParam<std::size_t> {};

// Every vertex of every shape against geometry, small and large meshes, in three poses. A straight
// way is as exact as the coordinates: 1e-16 of the largest, and a thousand diagonals away that is
// 1e-13 of the diagonal.
TEST_P(ConcavityOfSize, StraightWaysAreExact) {
    for (const test::ConcavityAnswer& answer : test::straight_answers(GetParam())) {
        for (const Eigen::Isometry3d& pose : poses(mesh_diagonal_m(answer.mesh))) {
            SCOPED_TRACE(answer.name + " at " + std::to_string(pose.translation().norm()));
            const ConcavityRun run = run_concavity(test::moved(answer.mesh, pose));
            EXPECT_LT(worst_error(answer, run.field), 1e-8);
        }
    }
}

TEST_P(ConcavityOfSize, BentWaysAreWithinHalfAPercent) {
    for (const test::ConcavityAnswer& answer : test::bent_answers(GetParam())) {
        for (const Eigen::Isometry3d& pose : poses(mesh_diagonal_m(answer.mesh))) {
            SCOPED_TRACE(answer.name + " at " + std::to_string(pose.translation().norm()));
            const ConcavityRun run = run_concavity(test::moved(answer.mesh, pose));
            EXPECT_LT(worst_error(answer, run.field), 0.005);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Faces, ConcavityOfSize, testing::Values(1000, 5000, 70000),
                         testing::PrintToStringParamName());

// A value is called exact where the straight way to the nearest plane is free: on every vertex of a
// convex body; in a channel on the middle of the floor, but not on a wall of 5 mm, 50 mm below the
// rim, where the nearest plane is on the wall's other side.
TEST(ShortestPathConcavity, FlagsTellWhatAValueIsWorth) {
    const ConcavityRun sphere = run_concavity(test::sphere(0.05, 1000));
    EXPECT_THAT(sphere.field.flag, testing::Each(ConcavityFlag::kExact));
    const TriangleMesh mesh = test::u_channel(0.05, 0.03, 0.005, 0.4, 4000);
    const ConcavityRun channel = run_concavity(mesh);
    int walls = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vector3d& p = mesh.vertices[v];
        const bool on_wall = std::abs(std::abs(p.x()) - 0.015) < 1e-9 && p.z() > -1e-9;
        if (!on_wall || p.z() > 0.044 || std::abs(p.y()) > 0.1) continue;
        ++walls;
        EXPECT_EQ(channel.field.flag[v], ConcavityFlag::kPath);
        EXPECT_LT(channel.field.parent[v], 0);
    }
    EXPECT_GT(walls, 20);
}

// Inside a closed shell there is no way out: infinity, never 0, whichever way the inner surfaces
// are wound; the shell's own outside is not touched by that.
TEST(ShortestPathConcavity, EnclosedIsInfinite) {
    const TriangleMesh outside = test::box({0.1, 0.1, 0.1}, 1200);
    const TriangleMesh hollow = test::box({0.08, 0.08, 0.08}, 700);
    const TriangleMesh core = test::sphere(0.02, 400);
    for (const TriangleMesh& inside : {hollow, test::inside_out(hollow)}) {
        for (const Eigen::Isometry3d& pose : poses(0.17)) {
            const TriangleMesh mesh =
                test::moved(test::joined(test::joined(outside, inside), core), pose);
            const ConcavityRun run = run_concavity(mesh);
            for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
                const bool out = v < outside.vertices.size();
                EXPECT_EQ(run.field.flag[v],
                          out ? ConcavityFlag::kExact : ConcavityFlag::kEnclosed);
                if (out) {
                    EXPECT_NEAR(run.field.value_m[v], 0.0, 1e-11);
                } else {
                    EXPECT_EQ(run.field.value_m[v], kInfinity);
                    EXPECT_EQ(run.field.parent[v], ConcavityField::kNoParent);
                    EXPECT_TRUE(escape_path(mesh, run.hull, run.field, v).empty());
                }
            }
            EXPECT_NEAR(run.field.largest_m, 0.0, 1e-11);
        }
    }
}

// A closed box in a closed shell as a file would hold it, with its own winding: through
// conditioning the answer is the same.
TEST(ShortestPathConcavity, EnclosedStaysSoThroughConditioning) {
    const TriangleMesh outside = test::box({0.1, 0.1, 0.1}, 300);
    const TriangleMesh soup =
        test::to_soup(test::joined(outside, test::inside_out(test::box({0.05, 0.05, 0.05}, 300))));
    const auto closed = condition_mesh(soup, {});
    ASSERT_TRUE(closed.ok()) << closed.error().detail;
    const ConcavityRun run = run_concavity(closed.value().mesh);
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
        const bool out = i < 3 * outside.faces.size();
        const auto v = static_cast<std::size_t>(closed.value().vertex_of_input[i]);
        EXPECT_EQ(run.field.value_m[v], out ? run.field.value_m[0] : kInfinity);
    }
}

TEST(ShortestPathConcavity, UnreferencedIsNan) {
    TriangleMesh mesh = test::cup(0.04, 0.09, 0.004, 1000);
    const std::size_t used = mesh.vertices.size();
    mesh.vertices.emplace_back(0.0, 0.0, 0.05);  // in the cup's hollow, so the hull stays the same
    const ConcavityRun run = run_concavity(mesh);
    EXPECT_EQ(run.field.flag[used], ConcavityFlag::kUnreferenced);
    EXPECT_TRUE(std::isnan(run.field.value_m[used]));
    EXPECT_TRUE(escape_path(mesh, run.hull, run.field, static_cast<std::uint32_t>(used)).empty());
    EXPECT_NEAR(run.field.largest_m, 0.086, 1e-9);
}

// A ball that hangs free in a cup is reached by no mesh edge. Its upper half sees the cup's mouth;
// from below the way leads round it, at most a quarter of a turn longer than straight up.
TEST(ShortestPathConcavity, APieceInAnothersHollowHasAWayOut) {
    const TriangleMesh cup = test::cup(0.04, 0.09, 0.004, 2000);
    Eigen::Isometry3d lift = Eigen::Isometry3d::Identity();
    lift.translation().z() = 0.04;
    const TriangleMesh mesh = test::joined(cup, test::moved(test::sphere(0.015, 800), lift));
    const ConcavityRun run = run_concavity(mesh);
    for (std::size_t v = cup.vertices.size(); v < mesh.vertices.size(); ++v) {
        const double up = 0.09 - mesh.vertices[v].z();
        const double below = std::max(0.0, 0.04 - mesh.vertices[v].z());
        if (below < 1e-9) {
            EXPECT_NEAR(run.field.value_m[v], up, 1e-9);
        } else {
            EXPECT_GT(run.field.value_m[v], up - 1e-9);
            EXPECT_LT(run.field.value_m[v], 0.05 + 1.02 * 0.015 * std::asin(below / 0.015));
        }
    }
}

// Two bars that cross: the mesh edges of one run through the other, and no way may follow them.
// What lies inside the other bar is enclosed; outside, at height z between the arms' ends, the
// slanted planes of the hull are nearest.
TEST(ShortestPathConcavity, EdgesThroughAnotherPartAreNoWay) {
    const TriangleMesh mesh =
        test::joined(test::box({0.3, 0.04, 0.04}, 4000), test::box({0.04, 0.3, 0.03}, 4000));
    const ConcavityRun run = run_concavity(mesh);
    int inside = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vector3d a = mesh.vertices[v].cwiseAbs();
        if (a.x() < 0.0199 && a.y() < 0.0199 && a.z() < 0.0199) {
            ++inside;
            EXPECT_EQ(run.field.flag[v], ConcavityFlag::kEnclosed) << mesh.vertices[v].transpose();
        } else if (a.x() > 0.03 || a.y() > 0.03) {
            EXPECT_TRUE(std::isfinite(run.field.value_m[v])) << mesh.vertices[v].transpose();
        }
    }
    EXPECT_GT(inside, 10);
}

// The same mesh gives the same bytes.
TEST(ShortestPathConcavity, IsRepeatable) {
    const TriangleMesh mesh =
        test::moved(test::hourglass(0.04, 0.01, 0.05, 0.015, 3000), test::random_pose(3));
    const ConcavityRun first = run_concavity(mesh), second = run_concavity(mesh);
    EXPECT_EQ(first.field.value_m, second.field.value_m);
    EXPECT_EQ(first.field.parent, second.field.parent);
}

TEST(ShortestPathConcavity, RefusesAnEmptyMeshOrHull) {
    const TriangleMesh mesh = test::box({1, 1, 1}, 12);
    const OuterHull hull = run_concavity(mesh).hull;
    const TriangleBvh bvh(mesh, 1e-6);
    const auto no_mesh = shortest_path_concavity({}, hull, bvh, {});
    ASSERT_FALSE(no_mesh.ok());
    EXPECT_EQ(no_mesh.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(no_mesh.error().detail, testing::HasSubstr("0 faces and 6 hull facets"));
    const auto no_hull = shortest_path_concavity(mesh, {}, bvh, {});
    ASSERT_FALSE(no_hull.ok());
    EXPECT_EQ(no_hull.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(no_hull.error().detail, testing::HasSubstr("12 faces and 0 hull facets"));
}

TEST(ShortestPathConcavity, FlagsHaveNames) {
    EXPECT_STREQ(to_string(ConcavityFlag::kExact), "exact");
    EXPECT_STREQ(to_string(ConcavityFlag::kPath), "path");
    EXPECT_STREQ(to_string(ConcavityFlag::kEnclosed), "enclosed");
    EXPECT_STREQ(to_string(ConcavityFlag::kUnreferenced), "unreferenced");
}

}  // namespace
}  // namespace graspd
