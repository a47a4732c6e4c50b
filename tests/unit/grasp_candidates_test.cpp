#include "graspd/grasp/grasp_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace graspd {
namespace {

using Eigen::Vector2d;
using Points2 = std::vector<Vector2d>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kGap_m = 0.006;

/// Points of a segment every 2 mm, both ends among them.
void add_line(Points2& line, const Vector2d& a, const Vector2d& b) {
    const int parts = static_cast<int>(std::lround((b - a).norm() / 0.002));
    for (int i = 0; i <= parts; ++i) line.push_back(a + (b - a) * i / parts);
}

/// Two sides of a neck, 40 high and 20 apart, up the left one and down the right one.
Points2 neck() {
    Points2 line;
    add_line(line, {0, 0}, {0, 0.04});
    add_line(line, {0.02, 0.04}, {0.02, 0});
    return line;
}

std::vector<GraspCandidate> candidates(const Points2& boundary, const std::vector<StepPoint>& steps,
                                       double opening_m, const GraspCandidatesConfig& config) {
    const auto result = grasp_candidates(boundary, steps, opening_m, kGap_m, config);
    EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().detail);
    return result.ok() ? result.value() : std::vector<GraspCandidate>{};
}

// Opening 50 in two widths, P = (0, 10). The circle of 25 cuts the right side at
// 10 +- sqrt(25^2 - 20^2) = 10 +- 15, of which 25 is on it, and the left side at 35. That of 50
// cuts nothing: the right side would have to reach 10 + 45.8.
TEST(GraspCandidates, TheCirclesCutsAreThePartners) {
    const auto found =
        candidates(neck(), {{{0, 0.01}, 5}}, 0.05, {.widths = 2, .tangent_widths = false});
    ASSERT_EQ(found.size(), 2U);
    for (const GraspCandidate& candidate : found) {
        EXPECT_LT((candidate.left_W - Vector2d(0, 0.01)).norm(), 1e-15);
        EXPECT_EQ(candidate.step, 0U);
        EXPECT_NEAR((candidate.right_W - candidate.left_W).norm(), 0.025, 1e-9);
    }
    const auto has = [&](const Vector2d& q) {
        return std::ranges::any_of(found,
                                   [&](const auto& c) { return (c.right_W - q).norm() < 1e-9; });
    };
    EXPECT_TRUE(has({0.02, 0.025}));
    EXPECT_TRUE(has({0, 0.035}));
}

// Straight across is the foot of the perpendicular, whether it falls on a vertex (P at 10) or
// between two (P at 11); it comes first, being the narrowest.
TEST(GraspCandidates, TheTangentCircleFindsTheShortestWayAcross) {
    for (const double y : {0.01, 0.011}) {
        const auto found =
            candidates(neck(), {{{0, y}, 5}}, 0.05, {.widths = 2, .tangent_widths = true});
        ASSERT_GE(found.size(), 3U) << y;
        EXPECT_LT((found[0].right_W - Vector2d(0.02, y)).norm(), 1e-9) << y;
    }
}

// A right side that leans by 3 : 4 with its foot inside: P-Q stands at right angles to it.
TEST(GraspCandidates, TheShortestWayStandsAtRightAnglesToASlantedSide) {
    Points2 line;
    add_line(line, {0, 0}, {0, 0.04});
    const Vector2d along(0.6, -0.8);
    add_line(line, {0.02, 0.06}, Vector2d(0.02, 0.06) + 0.08 * along);
    const auto found =
        candidates(line, {{{0, 0.02}, 9}}, 0.05, {.widths = 1, .tangent_widths = true});
    // |(P - (20, 60)) x along| = |-20 (-0.8) - (-40) 0.6| = 40: the foot is 40 away.
    ASSERT_FALSE(found.empty());
    const Vector2d across = found[0].right_W - found[0].left_W;
    EXPECT_NEAR(across.norm(), 0.040, 1e-9);
    EXPECT_NEAR(across.dot(along), 0.0, 1e-9);
}

// The convex corner of a boundary is nearest without a perpendicular on either leg.
TEST(GraspCandidates, ACornerThatPointsAtTheStepPointIsNearest) {
    Points2 line;
    add_line(line, {0, 0}, {0, 0.04});
    add_line(line, {0.04, 0.04}, {0.02, 0.02});
    line.pop_back();
    add_line(line, {0.02, 0.02}, {0.04, 0});
    const auto found =
        candidates(line, {{{0, 0.02}, 9}}, 0.05, {.widths = 1, .tangent_widths = true});
    ASSERT_FALSE(found.empty());
    EXPECT_LT((found[0].right_W - Vector2d(0.02, 0.02)).norm(), 1e-9);
}

// Nothing nearer than the lesser of the gap (6) and a quarter of the smallest width, and nothing
// beyond the opening: with an opening of 19 the other side, 20 away, is out of reach.
TEST(GraspCandidates, KeepsToTheHandsWidths) {
    std::vector<StepPoint> steps;
    for (int i = 0; i <= 20; ++i) steps.push_back({{0, 0.002 * i}, 0});
    for (const double opening_m : {0.019, 0.021, 0.05, 0.2}) {
        for (const std::uint32_t widths : {1U, 4U, 9U}) {
            const double first_m = opening_m / widths;
            const double least_m = std::min(kGap_m, 0.25 * first_m);
            std::size_t across = 0;
            for (const auto& c : candidates(neck(), steps, opening_m, {.widths = widths})) {
                const double width_m = (c.right_W - c.left_W).norm();
                EXPECT_GE(width_m, least_m - 1e-12);
                EXPECT_LE(width_m, opening_m + 1e-9);
                across += c.right_W.x() > 0.01;
            }
            EXPECT_EQ(across > 0, opening_m > 0.02) << opening_m;
        }
    }
}

TEST(GraspCandidates, ComeStepByStepWithRisingWidths) {
    const std::vector<StepPoint> steps = {{{0, 0.01}, 5}, {{0, 0.03}, 15}, {{0.02, 0.02}, 30}};
    const auto found = candidates(neck(), steps, 0.085, {});
    ASSERT_GT(found.size(), 6U);
    for (std::size_t i = 0; i + 1 < found.size(); ++i) {
        const auto& a = found[i];
        const auto& b = found[i + 1];
        ASSERT_LT(a.step, steps.size());
        EXPECT_EQ(a.left_W, steps[a.step].point);
        EXPECT_LE(a.step, b.step);
        if (a.step != b.step) continue;
        EXPECT_LE((a.right_W - a.left_W).norm(), (b.right_W - b.left_W).norm());
        EXPECT_NE(a.right_W, b.right_W);  // none twice
    }
    EXPECT_EQ(found.front().step, 0U);
    EXPECT_EQ(found.back().step, 2U);
}

// From the left side's end at (0, 40) to the right one's at (20, 40) it is a jump, no boundary: the
// circle of 10 about the left end would cut it at (10, 40).
TEST(GraspCandidates, AJumpIsNoBoundary) {
    const std::vector<StepPoint> end = {{{0, 0.04}, 19}};
    for (const auto& c : candidates(neck(), end, 0.04, {.widths = 4})) {
        EXPECT_TRUE(c.right_W.x() < 1e-9 || c.right_W.x() > 0.02 - 1e-9) << c.right_W.transpose();
    }
    const auto without_gaps =
        grasp_candidates(neck(), end, 0.04, std::numeric_limits<double>::infinity(), {});
    ASSERT_TRUE(without_gaps.ok());
    EXPECT_TRUE(std::ranges::any_of(without_gaps.value(), [](const auto& c) {
        return (c.right_W - Vector2d(0.01, 0.04)).norm() < 1e-9;
    }));
}

TEST(GraspCandidates, EveryErrorNamesItsCause) {
    const Points2 line = neck();
    const std::vector<StepPoint> steps = {{{0, 0.01}, 5}};
    const auto expect = [&](const Points2& boundary, const std::vector<StepPoint>& at,
                            double opening_m, double gap_m, const GraspCandidatesConfig& config,
                            const char* name) {
        const auto result = grasp_candidates(boundary, at, opening_m, gap_m, config);
        ASSERT_FALSE(result.ok()) << name;
        EXPECT_EQ(result.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_NE(result.error().detail.find(name), std::string::npos) << result.error().detail;
    };
    expect(line, steps, 0.0, kGap_m, {}, "opening_m");
    expect(line, steps, -0.1, kGap_m, {}, "opening_m");
    expect(line, steps, kNaN, kGap_m, {}, "opening_m");
    expect(line, steps, 0.05, 0.0, {}, "max_gap_m");
    expect(line, steps, 0.05, kNaN, {}, "max_gap_m");
    expect(line, steps, 0.05, kGap_m, {.widths = 0}, "widths");
    Points2 flawed = line;
    flawed[7].y() = kNaN;
    expect(flawed, steps, 0.05, kGap_m, {}, "boundary");
    expect(line, {{{0, 0.01}, 5}, {{kNaN, 0}, 0}}, 0.05, kGap_m, {}, "steps");
}

}  // namespace
}  // namespace graspd
