#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "graspd/mesh/condition_mesh.hpp"
#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/shapes.hpp"

// What must not change the concavity of a shape: where it stands, how its vertices are numbered,
// the unit of its numbers (all lengths scale together), whether faces share their vertices.

namespace graspd {
namespace {

constexpr std::uint64_t kSeeds[] = {1, 2, 3};

/// Values of every vertex of a soup, in its order, and what conditioning made of it.
struct Outcome {
    ConditionedMesh closed;
    std::vector<double> value_m;
    std::vector<ConcavityFlag> flag;
    double largest_m = 0.0;
};

Outcome outcome_of(const TriangleMesh& soup) {
    Outcome outcome;
    auto closed = condition_mesh(soup, {});
    EXPECT_TRUE(closed.ok()) << closed.error().detail;
    if (!closed.ok()) return outcome;
    outcome.closed = std::move(closed).value();
    const test::ConcavityRun run = test::run_concavity(outcome.closed.mesh);
    for (const std::int32_t v : outcome.closed.vertex_of_input) {
        const bool kept = v >= 0;
        const std::size_t place = kept ? static_cast<std::size_t>(v) : 0;
        outcome.value_m.push_back(kept ? run.field.value_m[place] : std::nan(""));
        outcome.flag.push_back(kept ? run.field.flag[place] : ConcavityFlag::kUnreferenced);
    }
    outcome.largest_m = run.field.largest_m;
    return outcome;
}

/// Vertex i of the one is vertex place[i] of the other, whose lengths are `scale` times as large.
/// Proven values agree to the last digits; the others are the lengths of ways found in an order
/// that the numbering changes, and agree to half a percent of the largest.
void expect_same(const Outcome& one, const Outcome& other, const std::vector<std::uint32_t>& place,
                 double scale) {
    ASSERT_EQ(place.size(), one.value_m.size());
    EXPECT_NEAR(other.closed.volume_m3, std::pow(scale, 3) * one.closed.volume_m3,
                1e-9 * std::pow(scale, 3) * one.closed.volume_m3);
    EXPECT_EQ(other.closed.mesh.faces.size(), one.closed.mesh.faces.size());
    EXPECT_EQ(other.closed.mesh.vertices.size(), one.closed.mesh.vertices.size());
    std::size_t flags_differ = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        const double expected = one.value_m[i] * scale, got = other.value_m[place[i]];
        const bool both_proven =
            one.flag[i] == ConcavityFlag::kExact && other.flag[place[i]] == ConcavityFlag::kExact;
        flags_differ += one.flag[i] != other.flag[place[i]];
        EXPECT_EQ(std::isfinite(got), std::isfinite(expected)) << i;
        if (!std::isfinite(got) || !std::isfinite(expected)) continue;
        // The floor is the rounding of coordinates of 100 m; a convex shape's largest value is 0.
        EXPECT_NEAR(got, expected, (both_proven ? 1e-9 : 5e-3) * one.largest_m * scale + 1e-12)
            << i;
    }
    // Where two planes are equally near, rounding chooses which one's ray decides.
    EXPECT_LE(flags_differ, place.size() / 20);
}

std::vector<std::uint32_t> in_place(std::size_t count) {
    std::vector<std::uint32_t> place;
    for (std::uint32_t i = 0; i < count; ++i) place.push_back(i);
    return place;
}

struct NamedMesh {
    std::string name;
    TriangleMesh mesh;
};
/// Hollows of every kind, among them a piece in another's hollow, a shell with something closed in,
/// and a mesh with flipped, doubled and missing faces.
std::vector<NamedMesh> meshes() {
    std::vector<NamedMesh> all;
    for (auto& answer : test::bent_answers(1500)) all.push_back({answer.name, answer.mesh});
    all.push_back({"hourglass", test::hourglass(0.04, 0.01, 0.05, 0.015, 1500)});
    all.push_back({"bowl", test::bowl(0.07, 0.005, 1500)});
    Eigen::Isometry3d lift = Eigen::Isometry3d::Identity();
    lift.translation().z() = 0.04;
    const TriangleMesh ball = test::moved(test::sphere(0.015, 400), lift);
    all.push_back({"ball in a cup", test::joined(test::cup(0.04, 0.09, 0.004, 1500), ball)});
    all.push_back({"ball in a shell",
                   test::joined(test::joined(test::box({0.1, 0.1, 0.2}, 600),
                                             test::inside_out(test::box({0.08, 0.08, 0.18}, 600))),
                                ball)});
    TriangleMesh damaged = test::torus(0.06, 0.02, 1500);
    damaged = test::with_flipped(damaged, test::choose_faces(damaged, 200, 5));
    damaged = test::with_duplicates(damaged, test::choose_faces(damaged, 30, 6));
    damaged = test::without(damaged, test::choose_faces(damaged, 8, 7));
    all.push_back({"damaged torus", damaged});
    return all;
}

TEST(MeshConcavity, DoesNotDependOnThePose) {
    for (const auto& [name, mesh] : meshes()) {
        const Outcome one = outcome_of(mesh);
        for (const std::uint64_t seed : kSeeds) {
            SCOPED_TRACE(name + " " + std::to_string(seed));
            Eigen::Isometry3d pose = test::random_pose(seed);
            if (seed == 3) pose.pretranslate(Eigen::Vector3d(100.0, -80.0, 60.0));
            expect_same(one, outcome_of(test::moved(mesh, pose)), in_place(mesh.vertices.size()),
                        1.0);
        }
    }
}

TEST(MeshConcavity, DoesNotDependOnTheOrder) {
    for (const auto& [name, mesh] : meshes()) {
        const Outcome one = outcome_of(mesh);
        for (const std::uint64_t seed : kSeeds) {
            SCOPED_TRACE(name + " " + std::to_string(seed));
            std::vector<std::uint32_t> place;
            const TriangleMesh other = test::shuffled(mesh, seed, &place);
            expect_same(one, outcome_of(other), place, 1.0);
        }
    }
}

TEST(MeshConcavity, ScalesWithTheObject) {
    for (const auto& [name, mesh] : meshes()) {
        const Outcome one = outcome_of(mesh);
        for (const double scale : {1e-3, 3.7, 1e3, 1e6}) {
            SCOPED_TRACE(name + " " + std::to_string(scale));
            expect_same(one, outcome_of(test::scaled(mesh, scale)), in_place(mesh.vertices.size()),
                        scale);
        }
    }
}

// Corner k of face f is vertex 3f + k of the soup; the soup knows no vertex without a face.
TEST(MeshConcavity, SharedAndSeparateVerticesAreTheSame) {
    for (const auto& [name, mesh] : meshes()) {
        SCOPED_TRACE(name);
        const Outcome one = outcome_of(mesh), other = outcome_of(test::to_soup(mesh));
        std::vector<std::uint32_t> place(mesh.vertices.size(), 0);
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
            for (std::uint32_t k = 0; k < 3; ++k) place[mesh.faces[f][k]] = 3 * f + k;
        }
        expect_same(one, other, place, 1.0);
    }
}

}  // namespace
}  // namespace graspd
