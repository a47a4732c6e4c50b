#include "pose_tolerance.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/collision_scene.hpp"
#include "support/shapes.hpp"

namespace graspd::planner_detail {
namespace {

// A block 40 mm wide between the pads, 60 mm deep and high about the origin. The hand comes from
// above: Gx along x, Gz down. Fingers reach 35 mm beyond the palm to the TCP, so with the TCP at
// height h the palm stands 35 mm + h - 30 mm above the block's top.
constexpr double kPalmToTcp_m = 0.035, kTop_m = 0.03, kWidth_m = 0.04;

class PoseToleranceTest : public testing::Test {
protected:
    PoseToleranceTest() {
        request_.grippers = {test::parallel_85()};
        request_.object_O = test::box({kWidth_m, 0.06, 0.06});
    }
    /// @param palm_gap_m  [m] from the palm to the block's top
    Grasp grasp(double palm_gap_m) const {
        Grasp grasp;
        grasp.X_FG.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
        grasp.X_FG.translation().z() = kTop_m + palm_gap_m - kPalmToTcp_m;
        grasp.width_m = kWidth_m;
        grasp.open_width_m = kWidth_m + 0.02;
        return grasp;
    }
    PoseTolerance measured(const Grasp& grasp) const {
        StageLog log;
        const auto object = prepare_object(request_.object_O, config_, log);
        if (!object) throw std::runtime_error(object.error().detail);
        const Surroundings surroundings(request_, object.value(), object.value().X_OP.inverse());
        const Judgement judgement{
            request_,
            object.value(),
            surroundings.world(),
            request_.grippers.front(),
            config_,
            object.value().X_OP,
            object.value().center_of_mass_P,
            0.07,
            Eigen::Vector3d(-object.value().X_OP.linear().row(2).transpose())};
        return pose_tolerance(grasp, judgement);
    }

    PlanRequest request_;
    PlannerConfig config_;
};

// Of 8, 4, 2, 1 and 0.5 mm the greatest that the palm's gap leaves room for; the pads, 20 mm wide,
// stay on the faces all the while.
TEST_F(PoseToleranceTest, TheGapBelowThePalmBoundsTheShift) {
    EXPECT_DOUBLE_EQ(measured(grasp(0.0085)).shift_m, 0.008);
    EXPECT_DOUBLE_EQ(measured(grasp(0.005)).shift_m, 0.004);
    EXPECT_DOUBLE_EQ(measured(grasp(0.0015)).shift_m, 0.001);
    EXPECT_DOUBLE_EQ(measured(grasp(0.0003)).shift_m, 0.0);
}

TEST_F(PoseToleranceTest, ThePadsGapBoundsTheShiftAlongTheClosingDirection) {
    Grasp narrow = grasp(0.005);
    narrow.open_width_m = kWidth_m + 0.003;
    EXPECT_NEAR(measured(narrow).shift_m, 0.0015, 1e-15);
}

// Walls on both sides of the palm, 40 mm across, at 2.5 mm.
TEST_F(PoseToleranceTest, WallsBesideThePalmBoundTheShiftAcross) {
    for (const double side : {-1.0, 1.0}) {
        OrientedBox wall;
        wall.pose.translation() = Eigen::Vector3d(0.0, side * (0.02 + 0.0025 + 0.005), 0.1);
        wall.half_extent = {0.1, 0.005, 0.05};
        request_.keep_out_F.push_back(wall);
    }
    EXPECT_DOUBLE_EQ(measured(grasp(0.005)).shift_m, 0.002);
}

// Pads turned by an angle about Gy or Gz press with a lean of that angle at least: what it stands
// is below the angle whose tangent is the friction. The TCP lies 9 mm below the top, so that no
// part of a finger above its pad touches first.
TEST_F(PoseToleranceTest, FrictionBoundsTheTurn) {
    const auto stood_rad = [&](double friction) {
        request_.options.friction = friction;
        return measured(grasp(0.026)).turn_rad;
    };
    EXPECT_DOUBLE_EQ(stood_rad(0.8), 0.2);  // the greatest that is tried
    EXPECT_LT(stood_rad(0.2), 0.2);         // tan 0.2 = 0.203
    EXPECT_LT(stood_rad(0.1), 0.1);         // tan 0.1 = 0.1003
    EXPECT_LT(stood_rad(0.05), 0.05);
    EXPECT_LE(stood_rad(0.1), stood_rad(0.2));
}

TEST_F(PoseToleranceTest, AGraspThatDoesNotHoldStandsNothing) {
    Grasp beside = grasp(0.005);
    beside.X_FG.translation().y() = 0.05;  // the pads pass by the block
    EXPECT_EQ(measured(beside).shift_m, 0.0);
    EXPECT_EQ(measured(beside).turn_rad, 0.0);
}

// An error that is not likely to hold is not stood, though nothing is in the way.
TEST_F(PoseToleranceTest, WhatIsLessLikelyToHoldThanNotIsNotStood) {
    config_.score_grasp.bias = -100.0;
    EXPECT_EQ(measured(grasp(0.005)).shift_m, 0.0);
}

}  // namespace
}  // namespace graspd::planner_detail
