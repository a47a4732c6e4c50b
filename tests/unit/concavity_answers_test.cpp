#include "support/concavity_answers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graspd/concavity/outer_hull.hpp"
#include "support/shape_builders.hpp"
#include "support/tunnels.hpp"
#include "support/vases.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

/// [m] to the nearest of the hull's planes.
double to_hull_m(const OuterHull& hull, const Vector3d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const HullFacet& facet : hull.facets) {
        nearest = std::min(nearest, facet.offset_m - facet.normal.dot(p));
    }
    return std::max(0.0, nearest);
}

class AnswersOfSize : public testing::TestWithParam<std::size_t> {};

// What any answer has to be, without a path: no way out is shorter than the distance to the nearest
// plane of the hull (and to no more than rounding below it), the hull's own vertices have 0, and a
// bracket is one. The meshes are closed.
TEST_P(AnswersOfSize, AreConsistentWithTheHull) {
    for (const std::string& name : test::answer_names()) {
        SCOPED_TRACE(name);
        const test::ConcavityAnswer answer = test::concavity_answer(name, GetParam());
        EXPECT_EQ(answer.name, name);
        EXPECT_TRUE(test::is_closed_manifold(answer.mesh));
        EXPECT_GT(test::signed_volume_m3(answer.mesh), 0.0);
        const auto hull = outer_hull(answer.mesh.vertices);
        ASSERT_TRUE(hull.ok());
        std::size_t too_short = 0, nonsense = 0, inverted = 0;
        for (const Vector3d& p : answer.mesh.vertices) {
            const double value = answer.value_m(p);
            if (std::isnan(value)) continue;
            const double highest = answer.highest_m ? answer.highest_m(p) : value;
            nonsense += !(value >= -1e-12 && value < 0.5);
            inverted += value > highest + 1e-15;
            too_short += highest < to_hull_m(hull.value(), p) - 1e-9;
        }
        EXPECT_EQ(nonsense, 0u);
        EXPECT_EQ(inverted, 0u);
        EXPECT_EQ(too_short, 0u);
        for (const std::uint32_t v : hull.value().vertices) {
            const double value = answer.value_m(answer.mesh.vertices[v]);
            EXPECT_TRUE(std::isnan(value) || value < 1e-9) << v << " has " << value;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Faces, AnswersOfSize, testing::Values(1000, 5000),
                         testing::PrintToStringParamName());

// From the dead end's far corner at (80, -90) mm in the plane of x and z by the sill (60, -55) and
// the lip (20, -35), then 35 mm up.
TEST(ConcavityAnswers, PlaneTunnelByHand) {
    const double way = std::hypot(0.02, 0.035) + std::hypot(0.04, 0.02) + 0.035;
    EXPECT_NEAR(test::tunnel_2d_concavity_m({0.08, 0.005, -0.09}), way, 1e-15);
    EXPECT_NEAR(test::tunnel_2d_concavity_m({0.02, 0.0, -0.055}), 0.055, 1e-15);
    const double seen = std::hypot(0.06, 0.021) + 0.035;  // at the far wall, just below the sill
    EXPECT_NEAR(test::tunnel_2d_concavity_m({0.08, 0.0, -0.056}), seen, 1e-15);
}

// The least length over a dense grid of places on both edges is as short, to the grid's square,
// and never shorter; both places are inside their edges.
TEST(ConcavityAnswers, SkewTunnelBendsInsideBothEdges) {
    constexpr int kSteps = 400;
    for (const Vector3d& p :
         {Vector3d(0.07, 0.08, -0.06), Vector3d(0.06, 0.08, -0.07), Vector3d(0.08, 0.06, -0.065)}) {
        double least = 1.0, z_least = 0.0, y_least = 0.0;
        for (int i = 0; i <= kSteps; ++i) {
            for (int k = 0; k <= kSteps; ++k) {
                const double z = -0.06 + 0.02 * i / kSteps, y = 0.02 * k / kSteps;
                const double way = test::tunnel_3d_way_m(p, z, y);
                if (way < least) least = way, z_least = z, y_least = y;
            }
        }
        const double value = test::tunnel_3d_concavity_m(p);
        EXPECT_LE(value, least + 1e-15);
        EXPECT_GT(value, least - 1e-6 * least);
        EXPECT_GT(z_least, -0.059);
        EXPECT_LT(z_least, -0.041);
        EXPECT_GT(y_least, 0.002);
        EXPECT_LT(y_least, 0.018);
    }
}

// The middle of the floor sees the mouth: 121 - 4 mm. The belly's widest ring winds round the lip,
// whose narrowest radius is 20 mm at 115 mm: longer than the straight line to that ring, by less
// than half a millimetre. At the waist, the distance to the line between the belly's and the lip's
// widest rings bounds the concavity.
TEST(ConcavityAnswers, VaseByHand) {
    const test::VaseAnswer answer = test::vase_answer(20000);
    EXPECT_NEAR(answer.lowest_m({0.0, 0.0, 0.004}), 0.117, 1e-15);
    const double straight = std::hypot(0.026, 0.075) + 0.006;
    EXPECT_GT(answer.lowest_m({0.046, 0.0, 0.04}), straight + 1e-6);
    EXPECT_LT(answer.lowest_m({0.046, 0.0, 0.04}), straight + 5e-4);
    EXPECT_GT(answer.lowest_m({0.03, 0.0, 0.095}), 0.005);
    EXPECT_LT(answer.lowest_m({0.03, 0.0, 0.095}), 0.008);
}

// The twisted vase's bracket narrows with the square of the sides: at 70k faces to 0.1 % of all
// values above 5 % of the largest.
TEST(ConcavityAnswers, TwistedBracketIsNarrow) {
    const test::ConcavityAnswer answer = test::concavity_answer("twisted vase", 70000);
    double worst = 0.0;
    for (const Vector3d& p : answer.mesh.vertices) {
        const double low = answer.value_m(p), high = answer.highest_m(p);
        if (high > 0.006) worst = std::max(worst, (high - low) / high);
    }
    EXPECT_LT(worst, 1e-3);
    EXPECT_GT(worst, 0.0);
}

}  // namespace
}  // namespace graspd
