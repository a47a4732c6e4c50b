#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/read_object.hpp"
#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/mesh_damage.hpp"
#include "support/path_certificate.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

/// None of it is the program's own ray test: every segment of every way is free under exact
/// predicates, the ways end on the hull and are as long as the values say, and what is called exact
/// is the distance to the nearest plane.
void expect_certified(const std::string& name, const TriangleMesh& mesh) {
    const test::ConcavityRun run = test::run_concavity(mesh);
    const test::PathCertificate found = test::certify_paths(mesh, run, test::ExactSurface(mesh));
    EXPECT_EQ(found.blocked, 0u) << "of " << found.segments << " segments";
    EXPECT_EQ(found.wrong_lengths, 0u) << "of " << found.paths << " paths";
    EXPECT_EQ(found.wrong_ends, 0u) << "of " << found.paths << " paths";
    EXPECT_EQ(found.strayed, 0u) << "of " << found.paths << " paths";
    EXPECT_EQ(found.not_exact, 0u) << "of " << found.exact << " vertices flagged exact";
    EXPECT_LE(100 * found.enclosed, found.vertices) << "nothing to certify";
    if (found.first_bad != test::PathCertificate::kNone) {
        ADD_FAILURE() << name << ": vertex " << found.first_bad << " at "
                      << mesh.vertices[found.first_bad].transpose() << ", value "
                      << run.field.value_m[found.first_bad];
    }
    EXPECT_GE(found.segments, found.paths);
    std::cout << name << ", " << mesh.faces.size() << " faces: " << found.segments << " segments, "
              << found.blocked << " blocked; "
              << 100.0 * static_cast<double>(found.exact) / static_cast<double>(found.vertices)
              << " % proven exact\n";
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param.substr(0, info.param.find('.'));
    std::ranges::replace(name, ' ', '_');
    return name;
}

class WaysOfShape : public testing::TestWithParam<std::string> {};

TEST_P(WaysOfShape, AreFreeUnderExactPredicates) {
    for (const std::size_t faces : {1000u, 5000u}) {
        const test::ConcavityAnswer answer = test::concavity_answer(GetParam(), faces);
        expect_certified(answer.name, test::moved(answer.mesh, test::random_pose(faces)));
    }
}

INSTANTIATE_TEST_SUITE_P(EscapePath, WaysOfShape, testing::ValuesIn(test::answer_names()),
                         test_name);

class WaysOfLargeShape : public testing::TestWithParam<std::string> {};

TEST_P(WaysOfLargeShape, AreFreeUnderExactPredicates) {
    const test::ConcavityAnswer answer = test::concavity_answer(GetParam(), 70000);
    expect_certified(answer.name, test::moved(answer.mesh, test::random_pose(7)));
}

INSTANTIATE_TEST_SUITE_P(EscapePath, WaysOfLargeShape,
                         testing::Values("undercut channel", "labyrinth", "tunnel_3d",
                                         "twisted vase"),
                         test_name);

class WaysOfScan : public testing::TestWithParam<std::string> {};

TEST_P(WaysOfScan, AreFreeUnderExactPredicates) {
    const auto file = read_object(GRASPD_SOURCE_DIR "/examples/objects/" + GetParam());
    ASSERT_TRUE(file.ok()) << file.error().detail;
    const auto closed = condition_mesh(std::get<TriangleMesh>(file.value().object), {});
    ASSERT_TRUE(closed.ok()) << closed.error().detail;
    expect_certified(GetParam(), closed.value().mesh);
}

INSTANTIATE_TEST_SUITE_P(EscapePath, WaysOfScan,
                         testing::Values("hammer.ply", "koala_bear.obj", "stacking_cup.ply"),
                         test_name);

// What the certificate rests on: a segment that touches one corner of the surface is blocked, one
// beside it is free; bars that cross intersect themselves, a closed shape does not.
TEST(ExactSurface, TellsBlockedFromFree) {
    const test::ExactSurface box(test::box({0.2, 0.2, 0.2}, 12));
    EXPECT_TRUE(box.blocks({0.0, 0.0, 0.0}, {0.0, 0.0, 0.3}));
    EXPECT_TRUE(box.blocks({0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}));
    EXPECT_FALSE(box.blocks({0.1, 0.1, std::nextafter(0.1, 1.0)}, {0.3, 0.3, 0.3}));
    EXPECT_FALSE(box.blocks({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0999}));
    const TriangleMesh bar = test::box({0.3, 0.04, 0.04}, 400);
    EXPECT_FALSE(test::intersects_itself(bar));
    EXPECT_TRUE(test::intersects_itself(test::joined(bar, test::box({0.04, 0.3, 0.03}, 400))));
}

// A certificate that cannot fail is none: each falsehood in a sound field shows up in its count.
TEST(PathCertificate, FindsWhatIsWrong) {
    const test::ConcavityAnswer channel = test::concavity_answer("undercut channel", 1000);
    const test::ExactSurface surface(channel.mesh);
    const test::ConcavityRun sound = test::run_concavity(channel.mesh);
    std::uint32_t v = 0;  // whose way bends
    while (sound.field.parent[v] < 0) ++v;
    const std::int32_t facet = sound.field.parent[static_cast<std::size_t>(sound.field.parent[v])];
    ASSERT_LT(facet, 0);

    test::ConcavityRun through_the_lid = sound;  // to the bend's hull plane straight
    const HullFacet& top = sound.hull.facets[static_cast<std::size_t>(-1 - facet)];
    through_the_lid.field.parent[v] = facet;
    through_the_lid.field.value_m[v] = top.offset_m - top.normal.dot(channel.mesh.vertices[v]);
    test::PathCertificate found = test::certify_paths(channel.mesh, through_the_lid, surface);
    EXPECT_GT(found.blocked, 0u);
    EXPECT_EQ(found.first_bad, v);

    test::ConcavityRun shortened = sound;
    shortened.field.value_m[v] *= 0.999;
    EXPECT_EQ(test::certify_paths(channel.mesh, shortened, surface).wrong_lengths, 1u);

    test::ConcavityRun called_exact = sound;
    called_exact.field.flag[v] = ConcavityFlag::kExact;
    EXPECT_EQ(test::certify_paths(channel.mesh, called_exact, surface).not_exact, 1u);
}

// From beneath the lid of an undercut channel: the vertex, the slot's lower edge, straight up to
// the hull's top. Worked by hand.
TEST(EscapePath, NamesTheBends) {
    const test::ConcavityAnswer channel = test::bent_answers(3000)[0];
    const test::ConcavityRun run = test::run_concavity(channel.mesh);
    int checked = 0;
    for (std::uint32_t v = 0; v < channel.mesh.vertices.size(); ++v) {
        const Vector3d& p = channel.mesh.vertices[v];
        const bool in_corner = std::abs(p.x() - 0.04) < 1e-9 && std::abs(p.z()) < 1e-9;
        if (!in_corner || std::abs(p.y()) > 0.09) continue;
        ++checked;
        const auto path = escape_path(channel.mesh, run.hull, run.field, v);
        ASSERT_EQ(path.size(), 3u);
        EXPECT_EQ(path[0], p);
        EXPECT_LT((path[1] - Vector3d(0.01, p.y(), 0.03)).norm(), 1e-9);
        EXPECT_LT((path[2] - Vector3d(0.01, p.y(), 0.036)).norm(), 1e-9);
    }
    EXPECT_GT(checked, 5);
}

}  // namespace
}  // namespace graspd
