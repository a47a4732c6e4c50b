#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "graspd/planner/planner.hpp"
#include "negative/verdict.hpp"
#include "support/clouds.hpp"
#include "support/plan_samples.hpp"
#include "support/shapes.hpp"

// Requests with one field out of range, through the whole planner: INVALID_REQUEST, a message that
// names field and value, no grasp.

namespace graspd::test {
namespace {

using Eigen::Vector3d;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct BadRequest {
    std::string name;
    std::function<void(PlanRequest&)> spoil;
    std::vector<std::string> says;
};
void PrintTo(const BadRequest& row, std::ostream* out) {
    *out << row.name;
}

using Spoil = std::function<void(PlanRequest&)>;
Spoil gripper(double Gripper::*field, double value) {
    return [=](PlanRequest& r) { r.grippers.front().*field = value; };
}
Spoil option(double PlanOptions::*field, double value) {
    return [=](PlanRequest& r) { r.options.*field = value; };
}
Spoil object(const std::variant<TriangleMesh, PointCloud>& value) {
    return [=](PlanRequest& r) { r.object_O = value; };
}
Spoil plane(const Vector3d& normal, double offset_m) {
    return [=](PlanRequest& r) { r.support_plane = SupportPlane{normal, offset_m}; };
}
Spoil cone(const Vector3d& axis, double angle_rad) {
    return [=](PlanRequest& r) { r.approach_cones = {{axis, angle_rad}}; };
}
Spoil keep_out(const Vector3d& half_extent) {
    return [=](PlanRequest& r) { r.keep_out_F = {{Eigen::Isometry3d::Identity(), half_extent}}; };
}
Spoil obstacle(const std::function<void(Obstacle&)>& change) {
    return [=](PlanRequest& r) {
        r.obstacles = {{box({0.1, 0.1, 0.1}), Eigen::Isometry3d::Identity()}};
        change(r.obstacles[0]);
    };
}
Spoil pose(const std::function<void(Eigen::Isometry3d&)>& change) {
    return [=](PlanRequest& r) { change(r.X_FO); };
}

const BadRequest kGripper[] = {
    {"NoGripper", [](PlanRequest& r) { r.grippers.clear(); }, {"grippers is empty"}},
    {"GripperTwice",
     [](PlanRequest& r) { r.grippers.push_back(r.grippers[0]); },
     {"grippers[1].name"}},
    {"MaxWidthZero", gripper(&Gripper::max_width_m, 0.0), {"gripper.max_width = 0 "}},
    {"MaxWidthHuge", gripper(&Gripper::max_width_m, 85.0), {"gripper.max_width = 85 "}},
    {"MaxWidthNan", gripper(&Gripper::max_width_m, kNan), {"gripper.max_width = nan"}},
    {"MinWidthNegative", gripper(&Gripper::min_width_m, -0.01), {"gripper.min_width = -0.01"}},
    {"MinWidthOverMax", gripper(&Gripper::min_width_m, 0.5), {"gripper.min_width = 0.5"}},
    {"FingerLengthZero", gripper(&Gripper::finger_length_m, 0.0), {"gripper.finger_length = 0 "}},
    {"FingerWidthNegative", gripper(&Gripper::finger_width_m, -2.0), {"gripper.finger_width = -2"}},
    {"FingerThicknessInfinite",
     gripper(&Gripper::finger_thickness_m, kInfinity),
     {"gripper.finger_thickness = inf"}},
    {"TipBehindTheFinger", gripper(&Gripper::tip_offset_m, 0.9), {"gripper.tip_offset = 0.9"}},
    {"PalmWidthZero", gripper(&Gripper::palm_width_m, 0.0), {"gripper.palm_width = 0 "}},
    {"PalmHeightNan", gripper(&Gripper::palm_height_m, kNan), {"gripper.palm_height = nan"}},
    {"PalmDepthNegative", gripper(&Gripper::palm_depth_m, -1.0), {"gripper.palm_depth = -1"}},
    {"PalmFarAway", gripper(&Gripper::palm_z_m, 3.0), {"gripper.palm_z = 3"}},
    {"YawInfinite", gripper(&Gripper::closing_yaw_rad, kInfinity), {"gripper.closing_yaw"}},
    {"TravelFalls",
     [](PlanRequest& r) {
         r.grippers[0].pad_travel = {{0.02, 0.1}, {0.01, 0.1}};
     },
     {"pad_travel row 1", "0.01"}},
};

const BadRequest kOptions[] = {
    {"NoGrasps", [](PlanRequest& r) { r.options.max_grasps = 0; }, {"options.max_grasps = 0 "}},
    {"BudgetZero", option(&PlanOptions::time_budget_s, 0.0), {"options.time_budget = 0 "}},
    {"BudgetNegative", option(&PlanOptions::time_budget_s, -2.0), {"options.time_budget = -2"}},
    {"BudgetNan", option(&PlanOptions::time_budget_s, kNan), {"options.time_budget = nan"}},
    {"FrictionZero", option(&PlanOptions::friction, 0.0), {"options.friction = 0 "}},
    {"FrictionHuge", option(&PlanOptions::friction, 101.0), {"options.friction = 101"}},
    {"ClearanceNegative",
     option(&PlanOptions::min_clearance_m, -0.001),
     {"options.min_clearance = -0.001"}},
    {"ClearanceHuge", option(&PlanOptions::min_clearance_m, 5.0), {"options.min_clearance = 5 "}},
    {"MassZero", [](PlanRequest& r) { r.options.mass_kg = 0.0; }, {"options.mass = 0 "}},
    {"MassInfinite", [](PlanRequest& r) { r.options.mass_kg = kInfinity; }, {"options.mass = inf"}},
    {"ForceZero", option(&PlanOptions::grip_force_N, 0.0), {"options.grip_force = 0 "}},
    {"UnknownSource", [](PlanRequest& r) { r.options.sources = 9; }, {"options.sources = 9 "}},
    {"CentreOfMassNan",
     [](PlanRequest& r) { r.options.center_of_mass_O = Vector3d(0, kNan, 0); },
     {"options.center_of_mass"}},
    {"GravityTooLong",
     [](PlanRequest& r) { r.options.gravity_F = Vector3d(0, 0, -9.81); },
     {"options.gravity = (", "-9.81"}},
    {"GravityZero",
     [](PlanRequest& r) { r.options.gravity_F = Vector3d::Zero(); },
     {"options.gravity = (0 0 0)"}},
};

const BadRequest kScene[] = {
    {"PoseNan",
     pose([](auto& X) { X.translation().x() = kNan; }),
     {"object_pose is no pose", "nan"}},
    {"PoseScaled", pose([](auto& X) { X.linear() *= 2.0; }), {"object_pose", "rotation off by"}},
    {"PoseMirrored", pose([](auto& X) { X.linear()(2, 2) = -1.0; }), {"object_pose"}},
    {"PlaneNotUnit", plane({0, 0, 3}, 0.0), {"support_plane.normal = (0 0 3)"}},
    {"PlaneOffsetNan", plane({0, 0, 1}, kNan), {"support_plane.offset = nan"}},
    {"ConeAxisZero", cone({0, 0, 0}, 0.5), {"approach_cones[0].axis = (0 0 0)"}},
    {"ConeAngleZero", cone({0, 0, 1}, 0.0), {"approach_cones[0].half_angle = 0 "}},
    {"ConeAngleOverPi", cone({0, 0, 1}, 3.2), {"approach_cones[0].half_angle = 3.2"}},
    {"KeepOutFlat", keep_out({0.1, 0.0, 0.1}), {"keep_out[0].half_extent = (0.1   0 0.1)"}},
    {"KeepOutNan", keep_out({0.1, kNan, 0.1}), {"keep_out[0].half_extent", "nan"}},
    {"ObstacleNan",
     obstacle([](Obstacle& o) { o.mesh.vertices[5].y() = kNan; }),
     {"obstacles[0].mesh vertex 5"}},
    {"ObstacleIndex",
     obstacle([](Obstacle& o) { o.mesh.faces[1][2] = 8; }),
     {"obstacles[0].mesh face 1 uses vertex 8 of 8"}},
    {"ObstaclePose",
     obstacle([](Obstacle& o) { o.X_FO.linear().setZero(); }),
     {"obstacles[0].pose is no pose"}},
};

const BadRequest kObject[] = {
    {"MeshEmpty", object(TriangleMesh{}), {"mesh is empty"}},
    {"CloudEmpty", object(PointCloud{}), {"cloud is empty"}},
    {"CloudFlat", object(PointCloud{box({0.1, 0.1, 0.0}, 400).vertices, {}}), {"is flat"}},
    {"MeshNan",
     object(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, kNan, 0}}, {{0, 1, 2}}}),
     {"mesh vertex 2 = (0, nan, 0)"}},
    {"MeshIndex",
     object(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}),
     {"mesh face 0 uses vertex 3 of 3"}},
    {"MeshInMillimetres",
     object(box({80, 60, 120}, 300)),
     {"object of 120 x 80 x 60 m", "factor 0.001", "--units mm"}},
    {"MeshInCentimetres",
     object(box({8, 6, 12}, 300)),
     {"factor 0.01 makes 120 x 80 x 60 mm", "--units cm"}},
    {"MeshScaledTwice",
     object(box({8e-5, 6e-5, 1.2e-4}, 300)),
     {"factor 1000 makes 120 x 80 x 60 mm"}},
    {"CloudInMillimetres", object(spiral_sphere(50.0, 500)), {"factor 0.001", "--units mm"}},
};

class Requests : public testing::TestWithParam<BadRequest> {};

TEST_P(Requests, AreRefusedWithFieldAndValue) {
    PlanRequest request = small_request();
    GetParam().spoil(request);
    const PlanReply reply = plan(request, {});
    EXPECT_EQ(reply.status, PlanStatus::kInvalidRequest);
    EXPECT_EQ(reply.request_id, request.request_id);
    EXPECT_TRUE(reply.grasps.empty());
    for (const std::string& part : GetParam().says) {
        EXPECT_NE(reply.message.find(part), std::string::npos)
            << reply.message << " lacks " << part;
    }
}

INSTANTIATE_TEST_SUITE_P(Gripper, Requests, testing::ValuesIn(kGripper), kName);
INSTANTIATE_TEST_SUITE_P(Options, Requests, testing::ValuesIn(kOptions), kName);
INSTANTIATE_TEST_SUITE_P(Scene, Requests, testing::ValuesIn(kScene), kName);
INSTANTIATE_TEST_SUITE_P(Object, Requests, testing::ValuesIn(kObject), kName);

}  // namespace
}  // namespace graspd::test
