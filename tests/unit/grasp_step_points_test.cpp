#include "graspd/grasp/step_points.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::Points2;
using test::sample_corners;

constexpr double kNoGap_m = std::numeric_limits<double>::infinity();

void expect_on_its_segment(const Points2& boundary, const StepPoint& step) {
    ASSERT_LT(step.segment + 1, boundary.size());
    const Eigen::Vector2d& a = boundary[step.segment];
    const Eigen::Vector2d& b = boundary[step.segment + 1];
    EXPECT_NEAR((step.point - a).norm() + (b - step.point).norm(), (b - a).norm(), 1e-9);
}

// Along a straight line the steps are r apart. Line 0..100, r = 10, hand 35: d_max at step k is
// 100 - 10 k, first not above 35 at k = 7; so the steps are 0, 10, ... 70.
TEST(StepPoints, AStraightLineIsDividedEvenly) {
    const Points2 line = sample_corners({{0, 0}, {60, 80}}, 3.0);
    const auto steps = step_points(line, 10.0, 35.0, kNoGap_m);
    ASSERT_TRUE(steps.ok());
    ASSERT_EQ(steps.value().size(), 8U);
    for (std::size_t k = 0; k < 8; ++k) {
        const double s = 10.0 * static_cast<double>(k);
        EXPECT_NEAR((steps.value()[k].point - Eigen::Vector2d(0.6 * s, 0.8 * s)).norm(), 0.0, 1e-9);
        expect_on_its_segment(line, steps.value()[k]);
    }
}

// The same when the whole line is one segment: a step may stay on the segment it stands on.
TEST(StepPoints, SeveralStepsOnOneSegment) {
    const auto steps = step_points(Points2{{0, 0}, {100, 0}}, 10.0, 35.0, kNoGap_m);
    ASSERT_TRUE(steps.ok());
    ASSERT_EQ(steps.value().size(), 8U);
    EXPECT_NEAR(steps.value().back().point.x(), 70.0, 1e-12);
    EXPECT_EQ(steps.value().back().segment, 0U);
}

// A chord r of a circle of radius R subtends theta = 2 asin(r / 2R). The boundary is a polygon of M
// sides, inside the circle by at most the sagitta s = R (1 - cos(pi / M)), which turns each step by
// at most 2 s tan(theta / 2) / R. The walk ends when the rest of the arc, 2 pi (1 - 1/M) - k theta,
// spans no more than the hand: 2 asin(w / 2R).
TEST(StepPoints, ChordsOfACircleSubtendEqualAngles) {
    const double radius = 0.05, step = 0.01, hand = 0.08;
    const int sides = 2000;
    const auto circle = test::circle_points({0, 0}, radius, sides);
    const auto steps = step_points(circle, step, hand, kNoGap_m);
    ASSERT_TRUE(steps.ok());

    const double pi = std::numbers::pi;
    const double theta = 2.0 * std::asin(step / (2.0 * radius));
    const double sagitta = radius * (1.0 - std::cos(pi / sides));
    const double turn = 2.0 * sagitta * std::tan(0.5 * theta) / radius;
    const double arc = 2.0 * pi * (1.0 - 1.0 / sides) - 2.0 * std::asin(hand / (2.0 * radius));
    ASSERT_EQ(steps.value().size(), static_cast<std::size_t>(std::ceil(arc / theta)) + 1);
    for (std::size_t k = 0; k < steps.value().size(); ++k) {
        const StepPoint& here = steps.value()[k];
        const auto count = static_cast<double>(k);
        const double angle = std::atan2(here.point.y(), here.point.x());
        const double off = std::remainder(angle - count * theta, 2.0 * pi);
        EXPECT_LE(std::abs(off), count * turn + 1e-12) << k;
        EXPECT_LE(here.point.norm(), radius + 1e-15);
        EXPECT_GE(here.point.norm(), radius - sagitta - 1e-15);
        expect_on_its_segment(circle, here);
        if (k == 0) continue;
        EXPECT_NEAR((here.point - steps.value()[k - 1].point).norm(), step, 1e-14);
    }
}

// Round the corner of a rectangle of 40 x 30 with r = 13, from (0, 0): (13, 0), (26, 0), (39, 0),
// then 1 to the corner and sqrt(13^2 - 1) = sqrt(168) up; (40, 12.96), (40, 25.96); then 4.04 are
// left to the corner, so the next is sqrt(169 - 4.04^2) along the top.
TEST(StepPoints, ARectangleIsWalkedRoundItsCorners) {
    const auto outline = sample_corners({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, 1.0);
    const auto steps = step_points(outline, 13.0, 30.0, kNoGap_m);
    ASSERT_TRUE(steps.ok());
    const double up = std::sqrt(168.0);
    const double along = std::sqrt(169.0 - (17.0 - up) * (17.0 - up));
    // From (40 - along, 30), 27.66 from the end (0, 30): within the hand, the walk ends.
    const Points2 expected = {{0, 0},   {13, 0},       {26, 0},         {39, 0},
                              {40, up}, {40, up + 13}, {40 - along, 30}};
    ASSERT_EQ(steps.value().size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_NEAR((steps.value()[k].point - expected[k]).norm(), 0.0, 1e-12) << k;
        expect_on_its_segment(outline, steps.value()[k]);
    }
}

// Into the inner corner of an L. From (40, 20) left along the shelf of 20 to the corner (20, 20),
// then up the wall of 20, r = 8: 32, 24, then 4 to the corner and sqrt(48) up; from there the end
// (20, 40) is 20 - 6.93 = 13.07 away, more than the hand of 10, so one more step of 8.
TEST(StepPoints, AnInnerCornerIsWalkedToo) {
    const auto line = sample_corners({{40, 20}, {20, 20}, {20, 40}}, 0.5);
    const auto steps = step_points(line, 8.0, 10.0, kNoGap_m);
    ASSERT_TRUE(steps.ok());
    const double up = std::sqrt(48.0);
    const Points2 expected = {{40, 20}, {32, 20}, {24, 20}, {20, 20 + up}, {20, 28 + up}};
    ASSERT_EQ(steps.value().size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_NEAR((steps.value()[k].point - expected[k]).norm(), 0.0, 1e-12) << k;
    }
}

// Two edges of a band, 60 apart, each 20 long in points 1 apart, r = 8, hand 15. Up the left one:
// 0, 8, 16; the next cut would lie behind the jump, so on at the first point of the right edge and
// down it: 20, 12; there the end, 12 away, is within the hand.
TEST(StepPoints, AJumpContinuesAtTheNextPiece) {
    Points2 boundary = sample_corners({{0, 0}, {0, 20}}, 1.0);
    for (const auto& point : sample_corners({{60, 20}, {60, 0}}, 1.0)) boundary.push_back(point);
    const auto steps = step_points(boundary, 8.0, 15.0, 4.0);
    ASSERT_TRUE(steps.ok());
    const Points2 expected = {{0, 0}, {0, 8}, {0, 16}, {60, 20}, {60, 12}};
    ASSERT_EQ(steps.value().size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_NEAR((steps.value()[k].point - expected[k]).norm(), 0.0, 1e-12) << k;
        expect_on_its_segment(boundary, steps.value()[k]);
    }
    EXPECT_EQ(steps.value()[3].segment, 21U);  // 21 points on the left edge, indices 0..20
}

// A lone last point behind a jump is a step point; it lies at the end of the last segment.
TEST(StepPoints, ALonePointIsAPieceOfItsOwn) {
    const auto steps = step_points(Points2{{0, 0}, {1, 0}, {50, 0}}, 8.0, 10.0, 4.0);
    ASSERT_TRUE(steps.ok());
    ASSERT_EQ(steps.value().size(), 2U);
    EXPECT_EQ(steps.value()[1].point, Eigen::Vector2d(50, 0));
    EXPECT_EQ(steps.value()[1].segment, 1U);
}

// All within the hand at once: the first boundary point is the only step point.
TEST(StepPoints, ASmallBoundaryHasOneStepPoint) {
    const auto steps = step_points(Points2{{0, 0}, {1, 0}, {2, 0}}, 0.5, 2.0, kNoGap_m);
    ASSERT_TRUE(steps.ok());
    ASSERT_EQ(steps.value().size(), 1U);
    EXPECT_EQ(steps.value()[0].point, Eigen::Vector2d(0, 0));
}

// Random walks with jumps: steps lie on their segments, segments never fall, and a step within one
// piece is a chord of length r.
TEST(StepPoints, StepsGoForwardInChordsOfEqualLength) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        std::mt19937 engine(seed);
        std::normal_distribution<double> move(0.0, 0.4);
        std::uniform_int_distribution<int> die(1, 40);
        Points2 walk = {{0, 0}};
        for (int k = 0; k < 400; ++k) {
            const Eigen::Vector2d jump(die(engine) == 1 ? 30.0 : 0.0, 0.0);
            walk.push_back(walk.back() + jump + Eigen::Vector2d(move(engine), move(engine)));
        }
        const auto steps = step_points(walk, 1.0, 2.0, 10.0);
        ASSERT_TRUE(steps.ok());
        EXPECT_GT(steps.value().size(), 10U);
        for (std::size_t k = 0; k < steps.value().size(); ++k) {
            const StepPoint& here = steps.value()[k];
            expect_on_its_segment(walk, here);
            if (k == 0) continue;
            const StepPoint& before = steps.value()[k - 1];
            EXPECT_GE(here.segment, before.segment);
            bool jumped = false;
            for (std::size_t n = before.segment; n < here.segment; ++n) {
                jumped = jumped || (walk[n + 1] - walk[n]).norm() > 10.0;
            }
            const bool at_the_end = here.point == walk.back();
            if (!jumped && !at_the_end) {
                EXPECT_NEAR((here.point - before.point).norm(), 1.0, 1e-9);
            }
        }
    }
}

TEST(StepPoints, EveryErrorNamesItsCause) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Points2 line = {{0, 0}, {1, 0}};
    const auto code = [](const Points2& boundary, double step, double hand, double gap) {
        const auto steps = step_points(boundary, step, hand, gap);
        return steps.ok() ? PlanErrorCode::kInternal : steps.error().code;
    };
    EXPECT_EQ(code({{0, 0}, {nan, 0}}, 0.1, 0.1, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(line, 0.0, 0.1, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(line, nan, 0.1, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(line, 0.1, -0.1, 1.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(line, 0.1, 0.1, 0.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(line, 0.1, 0.1, nan), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code({}, 0.1, 0.1, 1.0), PlanErrorCode::kDegenerate);
    EXPECT_EQ(code({{0, 0}}, 0.1, 0.1, 1.0), PlanErrorCode::kDegenerate);
    EXPECT_EQ(code(line, 1e-6, 0.1, 2.0), PlanErrorCode::kTooLarge);
    const auto steps = step_points(line, -3.0, 0.1, 1.0);
    ASSERT_FALSE(steps.ok());
    EXPECT_NE(steps.error().detail.find("step_m = -3"), std::string::npos);
}

}  // namespace
}  // namespace graspd
