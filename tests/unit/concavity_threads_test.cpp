#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/read_object.hpp"
#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/mesh_damage.hpp"

namespace graspd {
namespace {

/// Every bit of a field, and of the hull facets that its ways end on.
std::vector<std::uint64_t> bits_of(const ConcavityField& field) {
    std::vector<std::uint64_t> bits;
    const auto add = [&](const Eigen::Vector3d& p) {
        for (const double x : p) bits.push_back(std::bit_cast<std::uint64_t>(x));
    };
    for (std::size_t v = 0; v < field.value_m.size(); ++v) {
        bits.push_back(std::bit_cast<std::uint64_t>(field.value_m[v]));
        bits.push_back(static_cast<std::uint64_t>(field.flag[v]));
        bits.push_back(static_cast<std::uint64_t>(std::int64_t{field.parent[v]}));
        add(field.lifted[v]);
    }
    for (const EdgeBend& bend : field.edge_bends) {
        bits.push_back(static_cast<std::uint64_t>(std::int64_t{bend.parent}));
        add(bend.point);
        add(bend.lifted);
    }
    bits.push_back(std::bit_cast<std::uint64_t>(field.largest_m));
    return bits;
}

std::vector<std::uint64_t> bits_with(const TriangleMesh& mesh, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto measured = measure_concavity(mesh, {});
    EXPECT_TRUE(measured.ok());
    return bits_of(measured.value().field);
}

TriangleMesh scan(const std::string& name) {
    const auto file = read_object(std::string(GRASPD_SOURCE_DIR "/examples/objects/") + name);
    return condition_mesh(std::get<TriangleMesh>(file.value().object), {}).value().mesh;
}

// Ways with slid bends, tilted ends and jumps across the void, on one thread and on several.
TEST(ConcavityThreads, GiveTheSameBytes) {
    const std::vector<TriangleMesh> meshes = {
        test::moved(test::concavity_answer("labyrinth", 5000).mesh, test::random_pose(41)),
        test::moved(test::concavity_answer("twisted vase", 5000).mesh, test::random_pose(42)),
        scan("koala_bear.obj"), scan("stacking_cup.ply")};
    for (const TriangleMesh& mesh : meshes) {
        const std::vector<std::uint64_t> alone = bits_with(mesh, 1);
        EXPECT_EQ(bits_with(mesh, 2), alone);
        EXPECT_EQ(bits_with(mesh, 7), alone);
        const test::ConcavityRun steps = test::run_concavity(mesh);
        EXPECT_EQ(bits_of(steps.field), alone);  // stage by stage
    }
}

TEST(MeasureConcavity, TellsItsErrors) {
    EXPECT_EQ(measure_concavity({}, {}).error().code, PlanErrorCode::kInvalidInput);
    const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
    EXPECT_EQ(measure_concavity(flat, {}).error().code, PlanErrorCode::kDegenerate);
}

TEST(MeasureConcavity, NamesItsSteps) {
    const auto measured = measure_concavity(test::concavity_answer("cup", 1000).mesh, {});
    ASSERT_TRUE(measured.ok());
    std::string steps;
    for (const StepTime& time : measured.value().times) {
        steps += std::string(time.step) + " ";
        EXPECT_GE(time.ms, 0.0);
    }
    EXPECT_EQ(steps, "hull planes tree ground direct propagate reach shorten slide ");
}

}  // namespace
}  // namespace graspd
