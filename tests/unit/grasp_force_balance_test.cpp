#include "graspd/grasp/force_balance.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <Eigen/Geometry>

#include "support/plane_shapes.hpp"

namespace graspd {
namespace {

using test::Points2;

constexpr double kDeg = std::numbers::pi / 180.0;

/// 21 points on a line through (x, 0) that leans from Gy towards +Gx by `lean_rad`.
Points2 side_at(double x_m, double lean_rad) {
    Points2 side;
    for (int k = -10; k <= 10; ++k) {
        side.emplace_back(x_m + 0.001 * k * std::sin(lean_rad), 0.001 * k * std::cos(lean_rad));
    }
    return side;
}

/// Outward unit normals of the sides above.
Eigen::Vector3d left_normal(double lean_rad) {
    return {-std::cos(lean_rad), std::sin(lean_rad), 0.0};
}
Eigen::Vector3d right_normal(double lean_rad) {
    return -left_normal(lean_rad);
}

// A wedge whose faces lean 10 and 20 degrees the opposite way opens by 30 degrees.
TEST(ForceBalance, WedgeGivesItsOpeningAngle) {
    const auto balance =
        evaluate_force_balance(side_at(-0.02, -10 * kDeg), side_at(0.02, 20 * kDeg), {});
    ASSERT_TRUE(balance.ok());
    EXPECT_NEAR(balance.value().beta_rad, 30 * kDeg, 1e-12);
    EXPECT_NEAR(balance.value().lean_left_rad, 10 * kDeg, 1e-12);
    EXPECT_NEAR(balance.value().lean_right_rad, 20 * kDeg, 1e-12);
    EXPECT_NEAR(balance.value().rms_m, 0.0, 1e-15);
}

// Parallel sides have beta 0, upright or leaning: beta alone does not tell them apart.
TEST(ForceBalance, ParallelogramHasBetaZero) {
    for (const double lean : {0.0, 45 * kDeg, -45 * kDeg, 80 * kDeg}) {
        const auto balance = evaluate_force_balance(side_at(-0.02, lean), side_at(0.02, lean), {});
        ASSERT_TRUE(balance.ok());
        EXPECT_NEAR(balance.value().beta_rad, 0.0, 1e-12);
        EXPECT_NEAR(balance.value().lean_left_rad, -lean, 1e-12);
        EXPECT_NEAR(balance.value().lean_right_rad, lean, 1e-12);
    }
}

// Two sides of 55 degrees each open by 110: more than a right angle is not folded back to 70.
TEST(ForceBalance, AWideWedgeIsNotFolded) {
    const auto balance =
        evaluate_force_balance(side_at(-0.02, -55 * kDeg), side_at(0.02, 55 * kDeg), {});
    ASSERT_TRUE(balance.ok());
    EXPECT_NEAR(balance.value().beta_rad, 110 * kDeg, 1e-12);
}

// Both sides along the closing axis are one line: parallel, beta 0 and below pi.
TEST(ForceBalance, SidesAlongTheClosingAxisAreParallel) {
    const Points2 along = {{0.01, 0.0}, {0.02, 0.0}, {0.03, 0.0}};
    const auto balance = evaluate_force_balance(along, along, {});
    ASSERT_TRUE(balance.ok());
    EXPECT_EQ(balance.value().beta_rad, 0.0);
}

// Corners of a rectangle of 2 x 20 mm: the fitted line is its middle, every point is 1 mm off.
TEST(ForceBalance, RmsIsTheDistanceToTheLine) {
    const Points2 rough = {{-0.001, -0.01}, {0.001, -0.01}, {-0.001, 0.01}, {0.001, 0.01}};
    const auto balance = evaluate_force_balance(rough, side_at(0.02, 0.0), {});
    ASSERT_TRUE(balance.ok());
    EXPECT_NEAR(balance.value().rms_m, 0.001, 1e-15);
    EXPECT_NEAR(balance.value().beta_rad, 0.0, 1e-12);
}

// Any two leans, anywhere: beta = |lean_right - lean_left|, for leans within the right angle; a
// mirrored pair of sides and a shift change nothing.
TEST(ForceBalance, BetaIsTheDifferenceOfTheLeans) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> lean(-89 * kDeg, 89 * kDeg);
    std::uniform_real_distribution<double> shift(-0.5, 0.5);
    for (int round = 0; round < 200; ++round) {
        const double left = lean(engine), right = lean(engine);
        Points2 left_G = side_at(-0.02, left), right_G = side_at(0.02, right);
        const Eigen::Vector2d offset(shift(engine), shift(engine));
        for (auto& point : left_G) point += offset;
        for (auto& point : right_G) point += offset;
        const auto balance = evaluate_force_balance(left_G, right_G, {});
        ASSERT_TRUE(balance.ok());
        EXPECT_NEAR(balance.value().beta_rad, std::abs(right - left), 1e-11);
        EXPECT_LT(balance.value().beta_rad, std::numbers::pi);

        for (auto& point : left_G) point.x() = -point.x();
        for (auto& point : right_G) point.x() = -point.x();
        const auto mirrored = evaluate_force_balance(right_G, left_G, {});
        ASSERT_TRUE(mirrored.ok());
        EXPECT_NEAR(mirrored.value().beta_rad, balance.value().beta_rad, 1e-11);
        EXPECT_NEAR(mirrored.value().lean_left_rad, balance.value().lean_right_rad, 1e-11);
    }
}

TEST(ForceBalance, EveryErrorNamesItsCause) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Points2 good = side_at(0.02, 0.0);
    const auto code = [](const Points2& left_G, const Points2& right_G, double max_rms_m) {
        const auto balance = evaluate_force_balance(left_G, right_G, {.max_rms_m = max_rms_m});
        return balance.ok() ? PlanErrorCode::kInternal : balance.error().code;
    };
    EXPECT_EQ(code({{0, 0}}, good, 0.005), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(good, {}, 0.005), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code({{0, 0}, {nan, 1}}, good, 0.005), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(good, good, 0.0), PlanErrorCode::kInvalidInput);
    EXPECT_EQ(code(good, {{0.1, 0.1}, {0.1, 0.1}}, 0.005), PlanErrorCode::kDegenerate);
    // The corners of a square spread alike in every direction: no line is better than another.
    EXPECT_EQ(code({{0, 0}, {0.001, 0}, {0, 0.001}, {0.001, 0.001}}, good, 0.005),
              PlanErrorCode::kDegenerate);
    // 1 mm off the middle line, 0.5 mm allowed.
    const Points2 rough = {{-0.001, -0.01}, {0.001, -0.01}, {-0.001, 0.01}, {0.001, 0.01}};
    EXPECT_EQ(code(rough, good, 0.0005), PlanErrorCode::kDegenerate);
    const auto balance = evaluate_force_balance(good, rough, {.max_rms_m = 0.0005});
    ASSERT_FALSE(balance.ok());
    EXPECT_NE(balance.error().detail.find("right_G"), std::string::npos);
}

// Pads that close along X on a wedge of 10 + 20 degrees: the joining line is X, the worse face is
// turned by 20 degrees from it.
TEST(MinFriction, WedgeNeedsTheTangentOfItsWorseFace) {
    EXPECT_NEAR(
        min_friction({-0.02, 0, 0}, left_normal(-10 * kDeg), {0.02, 0, 0}, right_normal(20 * kDeg)),
        std::tan(20 * kDeg), 1e-12);
}

// Parallel faces that both lean by 45 degrees: beta 0, and yet tan 45 = 1 is needed.
TEST(MinFriction, ParallelogramOf45DegreesNeedsOne) {
    EXPECT_NEAR(
        min_friction({-0.02, 0, 0}, left_normal(45 * kDeg), {0.02, 0, 0}, right_normal(45 * kDeg)),
        1.0, 1e-12);
}

// Upright faces, but one contact 3 above the other at a distance of 4: tan = 3 / 4. The scale of
// normals does not matter.
TEST(MinFriction, OffsetContactsNeedFrictionOnUprightFaces) {
    EXPECT_NEAR(min_friction({0, 0, 0}, {-1, 0, 0}, {4, 0, 3}, {1, 0, 0}), 0.75, 1e-15);
    EXPECT_NEAR(min_friction({0, 0, 0}, {-7, 0, 0}, {4, 0, 3}, {0.1, 0, 0}), 0.75, 1e-15);
    EXPECT_EQ(min_friction({0, 0, 0}, {-1, 0, 0}, {4, 0, 0}, {1, 0, 0}), 0.0);
}

// At 90 degrees and beyond nothing holds; nor is there an answer without a direction.
TEST(MinFriction, NoFrictionHoldsWhatFacesAway) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(min_friction({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}), infinity);
    EXPECT_EQ(min_friction({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}), infinity);
    EXPECT_EQ(min_friction({1, 2, 3}, {-1, 0, 0}, {1, 2, 3}, {1, 0, 0}), infinity);
    EXPECT_EQ(min_friction({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}), infinity);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(min_friction({0, 0, 0}, {-1, nan, 0}, {1, 0, 0}, {1, 0, 0}), infinity);
}

// Exchanging the contacts, or turning everything, changes nothing.
TEST(MinFriction, DoesNotDependOnTheFrame) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] {
        return Eigen::Vector3d(number(engine), number(engine), number(engine));
    };
    for (int round = 0; round < 100; ++round) {
        const Eigen::Vector3d left = vector(), right = left + vector();
        const Eigen::Vector3d joining = (right - left).normalized();
        const Eigen::Vector3d n_left = -joining + 0.5 * vector(),
                              n_right = joining + 0.5 * vector();
        const double friction = min_friction(left, n_left, right, n_right);
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(number(engine), number(engine), number(engine), 1.0).normalized();
        EXPECT_NEAR(min_friction(turn * left, turn * n_left, turn * right, turn * n_right),
                    friction, 1e-9 * (1.0 + friction));
        EXPECT_EQ(min_friction(right, n_right, left, n_left), friction);
    }
}

}  // namespace
}  // namespace graspd
