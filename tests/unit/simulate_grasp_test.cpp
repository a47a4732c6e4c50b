#include <gtest/gtest.h>

#include <cstring>

#include "graspd/simulate/simulate_grasp.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

// The default gripper is parallel_85: fingers of 45 mm whose tips reach 10 mm beyond the TCP.

/// From above: Gx = x, Gz = -z. Up is z.
Grasp from_above(const Vector3d& tcp, double width_m, double open_width_m) {
    Grasp grasp;
    grasp.X_FG.linear().col(0) = Vector3d::UnitX();
    grasp.X_FG.linear().col(1) = -Vector3d::UnitY();
    grasp.X_FG.linear().col(2) = -Vector3d::UnitZ();
    grasp.X_FG.translation() = tcp;
    grasp.approach = {-Vector3d::UnitZ(), 0.1};
    grasp.width_m = width_m;
    grasp.open_width_m = open_width_m;
    return grasp;
}

SimulationResult run(const TriangleMesh& mesh, const Grasp& grasp,
                     const SimulationConfig& config = {},
                     const std::optional<SupportPlane>& plane = std::nullopt) {
    const auto result = simulate_grasp(mesh, Gripper{}, grasp, plane, config);
    EXPECT_TRUE(result.ok()) << result.error().detail;
    return result.ok() ? result.value() : SimulationResult{};
}

TriangleMesh cube() {
    return test::box({0.04, 0.04, 0.04});
}

Grasp middle_of_cube() {
    return from_above(Vector3d::Zero(), 0.04, 0.06);
}

// 0.1 kg weighs 0.98 N; friction 0.6 carries 2 x 0.6 x 20 = 24 N, so that 1 g of shaking more
// changes nothing. What moves in the hand is the creep of soft contacts.
TEST(SimulateGrasp, CubeInTheMiddleHolds) {
    const auto result = run(cube(), middle_of_cube());
    EXPECT_EQ(result.verdict, GraspVerdict::kHolds) << result.detail;
    EXPECT_EQ(result.phase, SimulationPhase::kShake);
    EXPECT_NEAR(result.width_m, 0.04, 0.001);
    EXPECT_LT(result.close_shift_m, 0.0005);
    EXPECT_LT(result.shift_m, 0.001);
    EXPECT_LT(result.turn_rad, 0.02);
}

// 2 x 0.02 x 20 = 0.8 N cannot carry 0.98 N.
TEST(SimulateGrasp, TooLittleFrictionDropsInTheLift) {
    SimulationConfig config;
    config.friction = 0.02;
    const auto result = run(cube(), middle_of_cube(), config);
    EXPECT_EQ(result.verdict, GraspVerdict::kDropped) << result.detail;
    EXPECT_EQ(result.phase, SimulationPhase::kLift);
}

// A plate of 10 mm falls out; the fingers then close at 0.2 m/s, so that after the 0.05 s that pass
// before it counts as lost they are where the pads meet, and not beyond.
TEST(SimulateGrasp, FingersStopAtTheirLeastWidth) {
    SimulationConfig config;
    config.friction = 0.02;
    const auto result =
        run(test::box({0.01, 0.04, 0.04}), from_above(Vector3d::Zero(), 0.01, 0.03), config);
    EXPECT_EQ(result.verdict, GraspVerdict::kDropped);
    EXPECT_NEAR(result.width_m, 0.0, 0.0005);
}

// The same by force: 0.8 N a finger at friction 0.6 carries 0.96 N.
TEST(SimulateGrasp, TooLittleForceDropsInTheLift) {
    SimulationConfig config;
    config.grip_force_N = 0.8;
    const auto result = run(cube(), middle_of_cube(), config);
    EXPECT_EQ(result.verdict, GraspVerdict::kDropped) << result.detail;
    EXPECT_EQ(result.phase, SimulationPhase::kLift);
}

TEST(SimulateGrasp, BesideTheCubeIsNoContact) {
    const auto result = run(cube(), from_above({0, 0.1, 0}, 0.04, 0.06));
    EXPECT_EQ(result.verdict, GraspVerdict::kNoContact);
    EXPECT_EQ(result.phase, SimulationPhase::kClose);
}

// Neither palm nor fingers touch a triangle of a block of 0.8 m: they lie wholly inside.
TEST(SimulateGrasp, InsideTheObjectIsCollision) {
    const auto result = run(test::box({0.8, 0.8, 0.8}), middle_of_cube());
    EXPECT_EQ(result.verdict, GraspVerdict::kCollision);
    EXPECT_EQ(result.phase, SimulationPhase::kApproach);
}

// Open by 42 mm the fingers pass a cube of 40 mm; 3 mm aside one of them meets it.
TEST(SimulateGrasp, FingerOnTheWayIsCollision) {
    EXPECT_EQ(run(cube(), from_above({0.003, 0, 0}, 0.04, 0.042)).verdict,
              GraspVerdict::kCollision);
}

// The fingertips end 10 mm below the TCP, where the plane is 5 mm below it.
TEST(SimulateGrasp, PlaneIsMet) {
    const SupportPlane plane{Vector3d::UnitZ(), -0.005};
    const auto result = run(cube(), middle_of_cube(), {}, plane);
    EXPECT_EQ(result.verdict, GraspVerdict::kCollision);
    EXPECT_NE(result.detail.find("plane"), std::string::npos) << result.detail;
}

// Across a cup's wall one finger stands in the cavity, which the cup's hull would fill. Its pad is
// 20 mm wide with edges rounded by 1 mm: they touch the cavity of radius 36 mm when their middles,
// 9 mm aside, are 35 mm from the axis, the pad then at sqrt(35^2 - 9^2) + 1 = 34.82 mm. The other
// pad is at 40 mm. Both press in by less than 0.1 mm.
TEST(SimulateGrasp, FingerInACupsCavityHolds) {
    const auto result =
        run(test::cup(0.04, 0.1, 0.004, 4000), from_above({0.038, 0, 0.09}, 0.004, 0.024));
    EXPECT_EQ(result.verdict, GraspVerdict::kHolds) << result.detail;
    EXPECT_NEAR(result.width_m, 0.04 - 0.03482, 0.0002);
}

// A bar held at its end: its weight turns it with 0.4 x 9.81 x 0.11 = 0.43 Nm, and what pads of
// 20 mm hold is at most 2 x 0.3 x 20 N x 14 mm (their corner) = 0.17 Nm. It hangs down in the end,
// still between the fingers.
TEST(SimulateGrasp, BarHeldAtItsEndSlips) {
    SimulationConfig config;
    config.friction = 0.3;
    config.mass_kg = 0.4;
    config.shake_m = 0.0;
    config.shake_rad = 0.0;
    const auto result =
        run(test::box({0.02, 0.24, 0.02}), from_above({0, 0.11, 0.0}, 0.02, 0.04), config);
    EXPECT_EQ(result.verdict, GraspVerdict::kSlips) << result.detail;
    EXPECT_GT(result.turn_rad, 0.55);
    EXPECT_LT(result.shift_m, 0.03);
}

// The cube's centre rises by the lift: the last frame shows it 0.2 m higher, where nothing shakes.
TEST(SimulateGrasp, FramesShowTheLift) {
    SimulationConfig config;
    config.frame_interval_s = 0.1;
    config.shake_m = 0.0;
    config.shake_rad = 0.0;
    const auto frames = run(cube(), middle_of_cube(), config).frames;
    ASSERT_GT(frames.size(), 40u);
    EXPECT_NEAR((frames.front().X_FG.translation() - Vector3d(0, 0, 0.1)).norm(), 0.0, 1e-12);
    EXPECT_EQ(frames.front().opening_m, 0.06);
    EXPECT_NEAR((frames.back().X_FO.translation() - Vector3d(0, 0, 0.2)).norm(), 0.0, 0.001);
    EXPECT_NEAR((frames.back().X_FG.translation() - Vector3d(0, 0, 0.2)).norm(), 0.0, 1e-12);
}

TEST(SimulateGrasp, SameBytesTwice) {
    SimulationConfig config;
    config.frame_interval_s = 0.1;
    const auto mesh = test::cup(0.03, 0.08, 0.004, 1000);
    const auto grasp = from_above({0, 0, 0.06}, 0.06, 0.08);
    const auto a = run(mesh, grasp, config), b = run(mesh, grasp, config);
    EXPECT_EQ(a.shift_m, b.shift_m);
    EXPECT_EQ(a.turn_rad, b.turn_rad);
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (std::size_t i = 0; i < a.frames.size(); ++i) {
        EXPECT_EQ(
            std::memcmp(a.frames[i].X_FO.data(), b.frames[i].X_FO.data(), 16 * sizeof(double)), 0);
    }
}

TEST(SimulateGrasp, RefusesWhatHasNoAnswer) {
    SimulationConfig config;
    config.mass_kg = 0.0;
    const auto no_mass = simulate_grasp(cube(), {}, middle_of_cube(), std::nullopt, config);
    ASSERT_FALSE(no_mass.ok());
    EXPECT_EQ(no_mass.error().code, PlanErrorCode::kInvalidInput);
    const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const auto flat = simulate_grasp(sheet, {}, middle_of_cube(), std::nullopt, {});
    ASSERT_FALSE(flat.ok());
    EXPECT_EQ(flat.error().code, PlanErrorCode::kDegenerate);
}

}  // namespace
}  // namespace graspd
