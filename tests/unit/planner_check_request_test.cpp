#include "check_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/plan_samples.hpp"

namespace graspd::planner_detail {
namespace {

using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(CheckRequest, AcceptsPlainAndFullRequests) {
    for (const PlanRequest& request : {test::small_request(), test::full_request()}) {
        const auto bad = check_request(request);
        EXPECT_FALSE(bad.has_value()) << bad->detail;
    }
}

// The ends of the ranges belong to them.
TEST(CheckRequest, AcceptsTheEndsOfTheRanges) {
    PlanRequest request = test::small_request();
    request.options.max_grasps = 1;
    request.options.min_clearance_m = 0.0;
    request.options.sources = 0;
    request.approach_cones = {{Vector3d::UnitX(), std::numbers::pi}};
    EXPECT_FALSE(check_request(request).has_value());
    request.options.sources = kAllSources;
    EXPECT_FALSE(check_request(request).has_value());
}

// A grasp of the reply says by name for which gripper it is.
TEST(CheckRequest, RefusesTwoGrippersOfOneName) {
    PlanRequest request = test::small_request();
    Gripper other = request.grippers.front();
    other.max_width_m *= 0.5;
    request.grippers.push_back(other);
    const auto bad = check_request(request);
    ASSERT_TRUE(bad.has_value());
    EXPECT_EQ(bad->code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(bad->detail, testing::HasSubstr("grippers[1].name = \"" + other.name + "\""));
    request.grippers.back().name += "_b";
    EXPECT_FALSE(check_request(request).has_value());
}

/// One flaw in an otherwise good request, and what its message must hold: field and value.
struct Flaw {
    std::function<void(PlanRequest&)> make;
    std::string field, value;
};

std::vector<Flaw> flaws_of_grippers() {
    const auto gripper = [](double Gripper::*field, double value) {
        return [field, value](PlanRequest& r) { r.grippers.front().*field = value; };
    };
    return {
        {[](auto& r) { r.grippers.clear(); }, "grippers", "empty"},
        {gripper(&Gripper::max_width_m, 0.0), "gripper.max_width", "= 0 "},
        {gripper(&Gripper::max_width_m, kNaN), "gripper.max_width", "nan"},
        {gripper(&Gripper::max_width_m, 2.5), "gripper.max_width", "2.5"},
        {gripper(&Gripper::min_width_m, -0.01), "gripper.min_width", "-0.01"},
        {gripper(&Gripper::min_width_m, 0.5), "gripper.min_width", "0.5"},
        {gripper(&Gripper::finger_length_m, 0.0), "gripper.finger_length", "= 0 "},
        {gripper(&Gripper::finger_width_m, -0.02), "gripper.finger_width", "-0.02"},
        {gripper(&Gripper::finger_thickness_m, kInfinity), "gripper.finger_thickness", "inf"},
        {gripper(&Gripper::tip_offset_m, 0.9), "gripper.tip_offset", "0.9"},
        {gripper(&Gripper::palm_width_m, 0.0), "gripper.palm_width", "= 0 "},
        {gripper(&Gripper::palm_height_m, kNaN), "gripper.palm_height", "nan"},
        {gripper(&Gripper::palm_depth_m, -1.0), "gripper.palm_depth", "-1"},
        {gripper(&Gripper::palm_z_m, -3.0), "gripper.palm_z", "-3"},
        {gripper(&Gripper::closing_yaw_rad, kNaN), "gripper.closing_yaw", "not a finite"},
        {[](auto& r) {
             r.grippers.front().pad_travel = {{0.02, 0.1}, {0.01, 0.1}};
         },
         "gripper.pad_travel", "0.01"},
        {[](auto& r) { r.grippers.push_back({}), r.grippers.back().max_width_m = -7.0; },
         "gripper.max_width", "-7"},
    };
}

std::vector<Flaw> flaws_of_options() {
    const auto option = [](double PlanOptions::*field, double value) {
        return [field, value](PlanRequest& r) { r.options.*field = value; };
    };
    return {
        {[](auto& r) { r.options.max_grasps = 0; }, "options.max_grasps", "= 0 "},
        {option(&PlanOptions::time_budget_s, 0.0), "options.time_budget", "= 0 "},
        {option(&PlanOptions::time_budget_s, -1.0), "options.time_budget", "-1"},
        {option(&PlanOptions::time_budget_s, kNaN), "options.time_budget", "nan"},
        {option(&PlanOptions::time_budget_s, kInfinity), "options.time_budget", "inf"},
        {option(&PlanOptions::friction, 0.0), "options.friction", "= 0 "},
        {option(&PlanOptions::friction, -0.5), "options.friction", "-0.5"},
        {option(&PlanOptions::friction, kNaN), "options.friction", "nan"},
        {option(&PlanOptions::min_clearance_m, -0.001), "options.min_clearance", "-0.001"},
        {option(&PlanOptions::min_clearance_m, kNaN), "options.min_clearance", "nan"},
        {[](auto& r) { r.options.mass_kg = 0.0; }, "options.mass", "= 0 "},
        {[](auto& r) { r.options.mass_kg = kNaN; }, "options.mass", "nan"},
        {option(&PlanOptions::grip_force_N, 0.0), "options.grip_force", "= 0 "},
        {option(&PlanOptions::grip_force_N, -20.0), "options.grip_force", "-20"},
        {[](auto& r) { r.options.sources = 8; }, "options.sources", "= 8 "},
        {[](auto& r) { r.options.center_of_mass_O = Vector3d(0.5, kNaN, 0); },
         "options.center_of_mass", "0.5"},
    };
}

std::vector<Flaw> flaws_of_poses() {
    const auto turned = [](auto&& change) {
        return [change](PlanRequest& r) { change(r.X_FO.linear()); };
    };
    return {
        {[](auto& r) { r.X_FO.translation().y() = kNaN; }, "object_pose", "nan"},
        {[](auto& r) { r.X_FO.translation().z() = kInfinity; }, "object_pose", "inf"},
        {turned([](auto&& m) { m.setZero(); }), "object_pose", "rotation off by"},
        {turned([](auto&& m) { m *= 1.5; }), "object_pose", "rotation off by"},
        {turned([](auto&& m) { m(0, 0) = kNaN; }), "object_pose", "nan"},
        {turned([](auto&& m) { m << -1, 0, 0, 0, 1, 0, 0, 0, 1; }), "object_pose", "rotation"},
    };
}

std::vector<Flaw> flaws_of_surroundings() {
    const auto plane = [](const Vector3d& normal, double offset_m) {
        return [=](PlanRequest& r) { r.support_plane = SupportPlane{normal, offset_m}; };
    };
    const auto obstacle = [](auto&& change) {
        return [change](PlanRequest& r) {
            const auto mesh = std::get<TriangleMesh>(test::small_request().object_O);
            r.obstacles = {{mesh, Eigen::Isometry3d::Identity()},
                           {mesh, Eigen::Isometry3d::Identity()}};
            change(r.obstacles[1]);
        };
    };
    const auto cone = [](const Vector3d& axis, double angle) {
        return [=](PlanRequest& r) {
            r.approach_cones = {{-Vector3d::UnitZ(), 1.0}, {axis, angle}};
        };
    };
    const auto keep_out = [](auto&& change) {
        return [change](PlanRequest& r) {
            r.keep_out_F = {{Eigen::Isometry3d::Identity(), Vector3d(0.1, 0.2, 0.3)}};
            change(r.keep_out_F[0]);
        };
    };
    const Vector3d x = Vector3d::UnitX();
    return {
        {plane({0, 0, 2}, 0.0), "support_plane.normal", "0 0 2"},
        {plane({0, 0, 0}, 0.0), "support_plane.normal", "0 0 0"},
        {plane({0, kNaN, 1}, 0.0), "support_plane.normal", "nan"},
        {plane({0, 0, 1}, kNaN), "support_plane.offset", "nan"},
        {plane({0, 0, 1}, kInfinity), "support_plane.offset", "inf"},
        {obstacle([](Obstacle& o) { o.X_FO.linear().setZero(); }), "obstacles[1].pose", "rotation"},
        {obstacle([](Obstacle& o) { o.mesh.vertices[2].x() = kNaN; }), "obstacles[1].mesh",
         "vertex 2"},
        {obstacle([](Obstacle& o) { o.mesh.faces[3][1] = 77; }), "obstacles[1].mesh",
         "face 3 uses vertex 77 of 4"},
        {cone(0.5 * x, 0.5), "approach_cones[1].axis", "0.5"},
        {cone({kNaN, 0, 1}, 0.5), "approach_cones[1].axis", "nan"},
        {cone(x, 0.0), "approach_cones[1].half_angle", "= 0 "},
        {cone(x, 3.2), "approach_cones[1].half_angle", "3.2"},
        {cone(x, kNaN), "approach_cones[1].half_angle", "nan"},
        {keep_out([](OrientedBox& b) { b.pose.translation().x() = kNaN; }), "keep_out[0].pose",
         "nan"},
        {keep_out([](OrientedBox& b) { b.half_extent.y() = 0.0; }), "keep_out[0].half_extent",
         "0.1"},
        {keep_out([](OrientedBox& b) { b.half_extent.z() = kNaN; }), "keep_out[0].half_extent",
         "nan"},
    };
}

TEST(CheckRequest, NamesTheFieldAndTheValue) {
    for (const auto& flaws :
         {flaws_of_grippers(), flaws_of_options(), flaws_of_poses(), flaws_of_surroundings()}) {
        for (const Flaw& flaw : flaws) {
            PlanRequest request = test::small_request();
            flaw.make(request);
            const auto bad = check_request(request);
            ASSERT_TRUE(bad.has_value()) << flaw.field << " " << flaw.value;
            EXPECT_EQ(bad->code, PlanErrorCode::kInvalidInput);
            EXPECT_NE(bad->detail.find(flaw.field), std::string::npos) << bad->detail;
            EXPECT_NE(bad->detail.find(flaw.value), std::string::npos)
                << bad->detail << " lacks " << flaw.value;
        }
    }
}

}  // namespace
}  // namespace graspd::planner_detail
