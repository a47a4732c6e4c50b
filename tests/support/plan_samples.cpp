#include "support/plan_samples.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace graspd::test {
namespace {

constexpr double kRight = std::numbers::pi / 2.0;
constexpr double kPoseTolerance = 1e-15;  // one rounding of a rotation matrix's entry, and a half

Eigen::Isometry3d pose(double x, double y, double z, const Eigen::Vector3d& axis) {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = Eigen::AngleAxisd(kRight, axis).toRotationMatrix();
    out.translation() = Eigen::Vector3d(x, y, z);
    return out;
}

TriangleMesh tetrahedron(double edge_m) {
    return {{{0, 0, 0}, {edge_m, 0, 0}, {0, edge_m, 0}, {0, 0, edge_m}},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

Gripper linkage_gripper() {
    Gripper gripper;
    gripper.name = "linkage";
    gripper.min_width_m = 0.0078125;
    gripper.max_width_m = 0.125;
    gripper.finger_length_m = 0.0625;
    gripper.finger_width_m = 0.03125;
    gripper.finger_thickness_m = 0.015625;
    gripper.tip_offset_m = 0.01171875;
    gripper.palm_width_m = 0.140625;
    gripper.palm_height_m = 0.0546875;
    gripper.palm_depth_m = 0.09375;
    gripper.palm_z_m = 0.0234375;
    gripper.closing_yaw_rad = 0.75;
    gripper.pad_travel = {{0.0078125, 0.171875}, {0.125, 0.15625}};
    return gripper;
}

Grasp sample_grasp(std::int32_t index) {
    Grasp grasp;
    grasp.X_FG = pose(0.25, 0.5, 0.75, Eigen::Vector3d::UnitX());
    grasp.X_FG_pregrasp = pose(0.25, 0.625, 0.75, Eigen::Vector3d::UnitX());
    grasp.X_FH = pose(0.25, 0.875, 0.75, Eigen::Vector3d::UnitZ());
    grasp.approach = {-Eigen::Vector3d::UnitY(), 0.125};
    grasp.retreat = {Eigen::Vector3d::UnitZ(), 0.0625};
    grasp.width_m = 0.03125;
    grasp.open_width_m = 0.0703125;
    grasp.contacts[0] = {{0.1, 0.2, 0.3}, -Eigen::Vector3d::UnitX()};
    grasp.contacts[1] = {{0.4, 0.5, 0.6}, Eigen::Vector3d::UnitX()};
    grasp.gripper_name = "linkage";
    grasp.concavity_index = index;
    grasp.concavity_depth_m = 0.019;
    grasp.clearance_m = 0.002;
    grasp.beta_rad = 0.1;
    grasp.min_friction = 0.05;
    grasp.min_force_N = 3.5;
    grasp.score = 0.7;
    grasp.terms = {{"bias", -1.0}, {"balance", 1.8}};
    grasp.source = index < 0 ? kWholeObject : kWall;
    if (index >= 0) grasp.tolerance = {0.004, 0.05};
    return grasp;
}

void expect_same(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const char* what) {
    EXPECT_EQ(a.translation(), b.translation()) << what;
    EXPECT_LE((a.linear() - b.linear()).cwiseAbs().maxCoeff(), kPoseTolerance) << what;
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.faces, b.faces);
}

void expect_same(const Gripper& a, const Gripper& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.min_width_m, b.min_width_m);
    EXPECT_EQ(a.max_width_m, b.max_width_m);
    EXPECT_EQ(a.finger_length_m, b.finger_length_m);
    EXPECT_EQ(a.finger_width_m, b.finger_width_m);
    EXPECT_EQ(a.finger_thickness_m, b.finger_thickness_m);
    EXPECT_EQ(a.tip_offset_m, b.tip_offset_m);
    EXPECT_EQ(a.palm_width_m, b.palm_width_m);
    EXPECT_EQ(a.palm_height_m, b.palm_height_m);
    EXPECT_EQ(a.palm_depth_m, b.palm_depth_m);
    EXPECT_EQ(a.palm_z_m, b.palm_z_m);
    EXPECT_EQ(a.closing_yaw_rad, b.closing_yaw_rad);
    ASSERT_EQ(a.pad_travel.size(), b.pad_travel.size());
    for (std::size_t i = 0; i < a.pad_travel.size(); ++i) {
        EXPECT_EQ(a.pad_travel[i].opening_m, b.pad_travel[i].opening_m);
        EXPECT_EQ(a.pad_travel[i].pad_z_m, b.pad_travel[i].pad_z_m);
    }
}

void expect_same(const PlanOptions& a, const PlanOptions& b) {
    EXPECT_EQ(a.max_grasps, b.max_grasps);
    EXPECT_EQ(a.time_budget_s, b.time_budget_s);
    EXPECT_EQ(a.friction, b.friction);
    EXPECT_EQ(a.min_clearance_m, b.min_clearance_m);
    EXPECT_EQ(a.mass_kg, b.mass_kg);
    EXPECT_EQ(a.center_of_mass_O, b.center_of_mass_O);
    EXPECT_EQ(a.gravity_F, b.gravity_F);
    EXPECT_EQ(a.grip_force_N, b.grip_force_N);
    EXPECT_EQ(a.sources, b.sources);
    EXPECT_EQ(a.want_suggestion, b.want_suggestion);
    EXPECT_EQ(a.want_markers, b.want_markers);
    EXPECT_EQ(a.seed, b.seed);
}

void expect_same_scene(const PlanRequest& a, const PlanRequest& b) {
    ASSERT_EQ(a.support_plane.has_value(), b.support_plane.has_value());
    if (a.support_plane) {
        EXPECT_EQ(a.support_plane->normal_F, b.support_plane->normal_F);
        EXPECT_EQ(a.support_plane->offset_m, b.support_plane->offset_m);
    }
    ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
    for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
        expect_same(a.obstacles[i].mesh, b.obstacles[i].mesh);
        expect_same(a.obstacles[i].X_FO, b.obstacles[i].X_FO, "obstacle");
    }
    ASSERT_EQ(a.approach_cones.size(), b.approach_cones.size());
    for (std::size_t i = 0; i < a.approach_cones.size(); ++i) {
        EXPECT_EQ(a.approach_cones[i].axis_F, b.approach_cones[i].axis_F);
        EXPECT_EQ(a.approach_cones[i].half_angle_rad, b.approach_cones[i].half_angle_rad);
    }
    ASSERT_EQ(a.keep_out_F.size(), b.keep_out_F.size());
    for (std::size_t i = 0; i < a.keep_out_F.size(); ++i) {
        expect_same(a.keep_out_F[i].pose, b.keep_out_F[i].pose, "keep-out box");
        EXPECT_EQ(a.keep_out_F[i].half_extent, b.keep_out_F[i].half_extent);
    }
}

void expect_same(const LinearMotion& a, const LinearMotion& b) {
    EXPECT_EQ(a.direction_F, b.direction_F);
    EXPECT_EQ(a.distance_m, b.distance_m);
}

void expect_same(const Grasp& a, const Grasp& b) {
    expect_same(a.X_FG, b.X_FG, "grasp");
    expect_same(a.X_FG_pregrasp, b.X_FG_pregrasp, "pre-grasp");
    expect_same(a.X_FH, b.X_FH, "hand");
    expect_same(a.approach, b.approach);
    expect_same(a.retreat, b.retreat);
    EXPECT_EQ(a.width_m, b.width_m);
    EXPECT_EQ(a.open_width_m, b.open_width_m);
    for (std::size_t side = 0; side < 2; ++side) {
        EXPECT_EQ(a.contacts[side].point_F, b.contacts[side].point_F);
        EXPECT_EQ(a.contacts[side].normal_F, b.contacts[side].normal_F);
    }
    EXPECT_EQ(a.gripper_name, b.gripper_name);
    EXPECT_EQ(a.concavity_index, b.concavity_index);
    EXPECT_EQ(a.concavity_depth_m, b.concavity_depth_m);
    EXPECT_EQ(a.clearance_m, b.clearance_m);
    EXPECT_EQ(a.beta_rad, b.beta_rad);
    EXPECT_EQ(a.min_friction, b.min_friction);
    EXPECT_EQ(a.min_force_N, b.min_force_N);
    ASSERT_EQ(a.tolerance.has_value(), b.tolerance.has_value());
    if (a.tolerance) {
        EXPECT_EQ(a.tolerance->shift_m, b.tolerance->shift_m);
        EXPECT_EQ(a.tolerance->turn_rad, b.tolerance->turn_rad);
    }
    EXPECT_EQ(a.score, b.score);
    EXPECT_EQ(a.source, b.source);
    ASSERT_EQ(a.terms.size(), b.terms.size());
    for (std::size_t i = 0; i < a.terms.size(); ++i) {
        EXPECT_EQ(a.terms[i].name, b.terms[i].name);
        EXPECT_EQ(a.terms[i].value, b.terms[i].value);
    }
}

void expect_same(const PlanReport& a, const PlanReport& b) {
    ASSERT_EQ(a.stages.size(), b.stages.size());
    for (std::size_t i = 0; i < a.stages.size(); ++i) {
        EXPECT_EQ(a.stages[i].name, b.stages[i].name);
        EXPECT_EQ(a.stages[i].ms, b.stages[i].ms);
        EXPECT_EQ(a.stages[i].in, b.stages[i].in);
        EXPECT_EQ(a.stages[i].out, b.stages[i].out);
    }
    ASSERT_EQ(a.rejections.size(), b.rejections.size());
    for (std::size_t i = 0; i < a.rejections.size(); ++i) {
        EXPECT_EQ(a.rejections[i].reason, b.rejections[i].reason);
        EXPECT_EQ(a.rejections[i].count, b.rejections[i].count);
    }
    ASSERT_EQ(a.near_misses.size(), b.near_misses.size());
    for (std::size_t i = 0; i < a.near_misses.size(); ++i) {
        expect_same(a.near_misses[i].X_FG, b.near_misses[i].X_FG, "near miss");
        EXPECT_EQ(a.near_misses[i].reason, b.near_misses[i].reason);
        EXPECT_EQ(a.near_misses[i].margin, b.near_misses[i].margin);
        EXPECT_EQ(a.near_misses[i].unit, b.near_misses[i].unit);
    }
    ASSERT_EQ(a.findings.size(), b.findings.size());
    for (std::size_t i = 0; i < a.findings.size(); ++i) {
        EXPECT_EQ(a.findings[i].code, b.findings[i].code);
        EXPECT_EQ(a.findings[i].value, b.findings[i].value);
        EXPECT_EQ(a.findings[i].detail, b.findings[i].detail);
    }
    EXPECT_EQ(a.suggestion, b.suggestion);
}

}  // namespace

PlanRequest small_request() {
    PlanRequest request;
    request.request_id = "small";
    request.frame_id = "base";
    request.object_O = tetrahedron(0.0625);
    request.grippers = {Gripper{}};
    request.grippers[0].name = "parallel_85";
    return request;
}

PlanRequest full_request() {
    PlanRequest request = small_request();
    request.request_id = "a request";
    request.frame_id = "table";
    request.X_FO = pose(1.5, -2.25, 0.125, Eigen::Vector3d::UnitY());
    request.grippers.push_back(linkage_gripper());
    request.support_plane = SupportPlane{-Eigen::Vector3d::UnitX(), -0.25};
    request.obstacles = {{tetrahedron(0.5), pose(0.5, 0, 0, Eigen::Vector3d::UnitX())},
                         {tetrahedron(0.25), pose(0, 0.5, 0, Eigen::Vector3d::UnitZ())}};
    request.approach_cones = {{-Eigen::Vector3d::UnitZ(), 0.5},
                              {Eigen::Vector3d::UnitX(), std::numbers::pi}};
    request.keep_out_F = {{pose(0, 0, -1, Eigen::Vector3d::UnitY()), {1.0, 2.0, 0.5}}};
    request.options = {.max_grasps = 7,
                       .time_budget_s = 2.5,
                       .friction = 0.4,
                       .min_clearance_m = 0.002,
                       .mass_kg = 0.3,
                       .center_of_mass_O = Eigen::Vector3d(0.01, 0.02, 0.03),
                       .gravity_F = Eigen::Vector3d(0.0, 0.6, -0.8),
                       .grip_force_N = 35.0,
                       .sources = kBoundary | kWholeObject,
                       .want_suggestion = true,
                       .want_markers = true,
                       .seed = 0xfedcba9876543210u};
    return request;
}

PlanReply full_reply() {
    PlanReply reply;
    reply.request_id = "a request";
    reply.frame_id = "table";
    reply.object_key = "0123456789abcdef";
    reply.status = PlanStatus::kPartial;
    reply.message = "time budget of 2.5 s ran out";
    reply.strategy = "mixed";
    reply.grasps = {sample_grasp(0), sample_grasp(-1)};
    reply.report.stages = {{"mesh/condition_mesh", 1.25, 400, 398},
                           {"concavity/shortest_path_concavity", 3.5, 398, 398}};
    reply.report.rejections = {{"palm_collision", 12}, {"too_wide", 5'000'000'000}};
    reply.report.near_misses = {
        {pose(0, 0, 1, Eigen::Vector3d::UnitZ()), "palm_collision", 0.001, "m"},
        {pose(0, 1, 0, Eigen::Vector3d::UnitX()), "friction", 0.02, "1"},
        {pose(1, 0, 0, Eigen::Vector3d::UnitY()), "beta", 0.1, "rad"}};
    reply.report.findings = {{"holes_filled", 2.0, "two holes were closed"}};
    reply.report.suggestion = "open the gripper by 4 mm more";
    return reply;
}

void expect_same(const PlanRequest& a, const PlanRequest& b) {
    EXPECT_EQ(a.request_id, b.request_id);
    EXPECT_EQ(a.frame_id, b.frame_id);
    ASSERT_EQ(a.object_O.index(), b.object_O.index());
    if (const auto* mesh = std::get_if<TriangleMesh>(&a.object_O)) {
        expect_same(*mesh, std::get<TriangleMesh>(b.object_O));
    } else {
        const auto& cloud_a = std::get<PointCloud>(a.object_O);
        const auto& cloud_b = std::get<PointCloud>(b.object_O);
        EXPECT_EQ(cloud_a.points, cloud_b.points);
        EXPECT_EQ(cloud_a.sensor_origin, cloud_b.sensor_origin);
    }
    expect_same(a.X_FO, b.X_FO, "object");
    ASSERT_EQ(a.grippers.size(), b.grippers.size());
    for (std::size_t i = 0; i < a.grippers.size(); ++i) expect_same(a.grippers[i], b.grippers[i]);
    expect_same_scene(a, b);
    expect_same(a.options, b.options);
}

void expect_same(const PlanReply& a, const PlanReply& b) {
    EXPECT_EQ(a.request_id, b.request_id);
    EXPECT_EQ(a.frame_id, b.frame_id);
    EXPECT_EQ(a.object_key, b.object_key);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.message, b.message);
    EXPECT_EQ(a.strategy, b.strategy);
    ASSERT_EQ(a.grasps.size(), b.grasps.size());
    for (std::size_t i = 0; i < a.grasps.size(); ++i) expect_same(a.grasps[i], b.grasps[i]);
    expect_same(a.report, b.report);
}

}  // namespace graspd::test
