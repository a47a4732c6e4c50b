#include "convert_moveit.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace graspd::dds {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace primitive = shape_msgs::msg::dds_::SolidPrimitive__Constants;
namespace codes = moveit::MoveItErrorCodes__Constants;

geometry_msgs::msg::dds_::Pose_ pose(double x, double y, double z) {
    return write_pose(Eigen::Isometry3d(Eigen::Translation3d(x, y, z)));
}

/// A quarter turn about z at a place.
geometry_msgs::msg::dds_::Pose_ turned(double x, double y, double z) {
    Eigen::Isometry3d out(Eigen::Translation3d(x, y, z));
    out.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return write_pose(out);
}

shape_msgs::msg::dds_::SolidPrimitive_ solid(std::uint8_t type, std::vector<double> dimensions) {
    shape_msgs::msg::dds_::SolidPrimitive_ out;
    out.type(type);
    out.dimensions(std::move(dimensions));
    return out;
}

shape_msgs::msg::dds_::Plane_ plane(std::array<double, 4> coef) {
    shape_msgs::msg::dds_::Plane_ out;
    out.coef(coef);
    return out;
}

/// A box of 40 x 60 x 80 mm that stands on z = 0 of "base".
MoveItCall box_call() {
    MoveItCall call;
    call.target().header().frame_id("base");
    call.target().header().stamp().sec(7);
    call.target().id("block");
    call.target().pose(pose(0.5, 0.0, 0.04));
    call.target().primitives().push_back(solid(primitive::BOX_, {0.04, 0.06, 0.08}));
    return call;
}

moveit::CollisionObject_ obstacle(const std::string& id) {
    moveit::CollisionObject_ out;
    out.id(id);
    out.pose(pose(0, 0, 0));
    return out;
}

std::vector<Gripper> two_grippers() {
    Gripper first, second;
    first.name = "first";
    second.name = "second";
    return {first, second};
}

/// The second one's parent link lies 0.1 behind H, turned by a quarter about Hz.
MoveItSettings settings() {
    MoveItSettings out;
    out.error_codes = MoveItCodes::kJazzy;
    MoveItHand hand;
    hand.gripper = "second";
    hand.parent_link = "wrist";
    hand.X_HP.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    hand.X_HP.translation() << 0, 0, -0.1;
    hand.joints = {{"finger", true, {{0.0, 0.0}, {0.08, 0.04}}}};
    out.hands = {hand};
    return out;
}

PlanRequest converted(const MoveItCall& call) {
    auto request = read_moveit_call(call, "moveit-1", two_grippers(), settings());
    EXPECT_TRUE(request.ok()) << request.error().detail;
    return request.ok() ? std::move(request).value() : PlanRequest{};
}

std::string error_of(const MoveItCall& call, PlanErrorCode code = PlanErrorCode::kInvalidInput) {
    const auto request = read_moveit_call(call, "moveit-1", two_grippers(), settings());
    EXPECT_FALSE(request.ok());
    if (request.ok()) return "";
    EXPECT_EQ(request.error().code, code) << request.error().detail;
    return request.error().detail;
}

Eigen::AlignedBox3d bounds_F(const PlanRequest& request) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& vertex : std::get<TriangleMesh>(request.object_O).vertices) {
        bounds.extend(request.X_FO * vertex);
    }
    return bounds;
}

TEST(ReadMoveIt, ABoxStandsWhereItsPoseSays) {
    const PlanRequest request = converted(box_call());
    EXPECT_EQ(request.request_id, "moveit-1");
    EXPECT_EQ(request.frame_id, "base");
    EXPECT_EQ(request.grippers.at(0).name, "first");  // no name: the first by name
    const Eigen::AlignedBox3d bounds = bounds_F(request);
    EXPECT_LT((bounds.min() - Eigen::Vector3d(0.48, -0.03, 0.0)).norm(), 1e-12);
    EXPECT_LT((bounds.max() - Eigen::Vector3d(0.52, 0.03, 0.08)).norm(), 1e-12);
    EXPECT_TRUE(request.candidates_FH.empty());
    EXPECT_FALSE(request.support_plane);
}

// The object is turned by a quarter, so that its x points along y of F; the part 0.1 along the
// object's x stands 0.1 along y, and a cylinder without a pose at the object's own.
TEST(ReadMoveIt, PartsAreOneObjectAndTheirPosesCompose) {
    MoveItCall call = box_call();
    call.target().pose(turned(1.0, 0.0, 0.0));
    call.target().primitive_poses().push_back(pose(0.1, 0.0, 0.0));
    call.target().primitives().push_back(solid(primitive::CYLINDER_, {0.2, 0.01}));
    shape_msgs::msg::dds_::Mesh_ mesh =
        write_mesh({{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.5}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
    call.target().meshes().push_back(mesh);
    const PlanRequest request = converted(call);
    const auto& whole = std::get<TriangleMesh>(request.object_O);
    EXPECT_EQ(whole.vertices.size(), 4u + 8u + 128u);
    EXPECT_EQ(whole.faces.size(), 4u + 12u + 252u);
    EXPECT_EQ(whole.faces[4], (Triangle{4, 6, 7}));  // the box's first, behind the mesh's vertices
    const Eigen::AlignedBox3d bounds = bounds_F(request);
    EXPECT_NEAR(bounds.max().y(), 0.1 + 0.02, 1e-12);  // the box's 40 mm side, about 0.1
    EXPECT_NEAR(bounds.min().x(), 1.0 - 0.03, 1e-12);  // its 60 mm side
    EXPECT_NEAR(bounds.min().z(), -0.1, 1e-12);        // the cylinder
    EXPECT_NEAR(bounds.max().z(), 0.5, 1e-12);         // the mesh
}

TEST(ReadMoveIt, GroupNamesTheGripper) {
    MoveItCall call = box_call();
    call.group_name("second");
    EXPECT_EQ(converted(call).grippers.at(0).name, "second");
    call.group_name("third");
    EXPECT_THAT(error_of(call, PlanErrorCode::kUnknownGripper),
                AllOf(HasSubstr("group_name = \"third\""), HasSubstr("first, second")));
    MoveItSettings chosen = settings();
    chosen.gripper = "second";
    const auto request = read_moveit_call(box_call(), "m", two_grippers(), chosen);
    ASSERT_TRUE(request.ok());
    EXPECT_EQ(request.value().grippers.at(0).name, "second");
}

// The table's plane is given upside down and through its pose: -z - 0.02 = 0 raised by 0.02 is
// z = 0, and the object is above it.
TEST(ReadMoveIt, ThePlaneOfASupportCarriesTheObject) {
    MoveItCall call = box_call();
    auto table = obstacle("table");
    table.pose(pose(0, 0, 0.02));
    table.planes().push_back(plane({0, 0, -2, -0.04}));
    call.movable_obstacles().push_back(table);
    call.support_surfaces().push_back("table");
    const PlanRequest request = converted(call);
    ASSERT_TRUE(request.support_plane);
    EXPECT_LT((request.support_plane->normal_F - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(request.support_plane->offset_m, 0.0, 1e-12);
    EXPECT_TRUE(request.keep_out_F.empty());
}

// A wall at x = 0.7, which is no support: what lies behind it is not to be entered, the object's
// side is free.
TEST(ReadMoveIt, AnyOtherPlaneIsNotToBeEntered) {
    MoveItCall call = box_call();
    auto wall = obstacle("wall");
    wall.planes().push_back(plane({1, 0, 0, -0.7}));
    call.movable_obstacles().push_back(wall);
    const PlanRequest request = converted(call);
    EXPECT_FALSE(request.support_plane);
    ASSERT_EQ(request.keep_out_F.size(), 1u);
    const OrientedBox& box = request.keep_out_F[0];
    const auto holds = [&](double x, double y, double z) {
        const Eigen::Vector3d in = box.pose.inverse() * Eigen::Vector3d(x, y, z);
        return (in.cwiseAbs().array() <= box.half_extent.array()).all();
    };
    EXPECT_TRUE(holds(0.701, 0, 0));
    EXPECT_TRUE(holds(5, 5, -5));
    EXPECT_FALSE(holds(0.699, 0, 0));
    EXPECT_FALSE(holds(0.699, 5, -5));
}

TEST(ReadMoveIt, ObstaclesKeepTheirParts) {
    MoveItCall call = box_call();
    auto shelf = obstacle("shelf");
    shelf.pose(turned(1.0, 2.0, 3.0));
    shelf.primitives().push_back(solid(primitive::BOX_, {0.1, 0.2, 0.3}));
    shelf.primitives().push_back(solid(primitive::SPHERE_, {0.1}));
    shelf.primitive_poses().push_back(pose(0.0, 0.0, 0.0));
    shelf.primitive_poses().push_back(pose(0.5, 0.0, 0.0));
    call.movable_obstacles().push_back(shelf);
    const PlanRequest request = converted(call);
    ASSERT_EQ(request.obstacles.size(), 2u);
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& v : request.obstacles[1].mesh.vertices) {
        bounds.extend(request.obstacles[1].X_FO * v);
    }
    EXPECT_LT((bounds.center() - Eigen::Vector3d(1.0, 2.5, 3.0)).norm(), 1e-12);
}

// The wrist's pose says the hand's: H stands 0.1 before it, turned back by a quarter.
TEST(ReadMoveIt, CandidatesAreHandPoses) {
    MoveItCall call = box_call();
    call.group_name("second");
    call.candidate_grasps().resize(12);
    for (auto& grasp : call.candidate_grasps()) {
        grasp.grasp_pose().pose(turned(0.2, 0.3, 0.4));
    }
    const PlanRequest request = converted(call);
    ASSERT_EQ(request.candidates_FH.size(), 12u);
    EXPECT_LT((request.candidates_FH[0].translation() - Eigen::Vector3d(0.2, 0.3, 0.5)).norm(),
              1e-12);
    EXPECT_LT((request.candidates_FH[0].linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_EQ(request.options.max_grasps, 12u);  // each may be answered
}

TEST(ReadMoveIt, ErrorsNameTheField) {
    const auto with = [](const auto& change) {
        MoveItCall call = box_call();
        change(call);
        return error_of(call);
    };
    EXPECT_THAT(with([](MoveItCall& c) { c.target().primitives().clear(); }),
                AllOf(HasSubstr("target has neither"), HasSubstr("\"block\"")));
    EXPECT_THAT(with([](MoveItCall& c) { c.target().operation(1); }),
                HasSubstr("target.operation = 1"));
    EXPECT_THAT(with([](MoveItCall& c) {
                    c.target().planes().push_back(plane({0, 0, 1, 0}));
                }),
                HasSubstr("target.planes"));
    EXPECT_THAT(with([](MoveItCall& c) { c.target().pose().orientation().w(0.0); }),
                HasSubstr("target.pose.orientation"));
    EXPECT_THAT(with([](MoveItCall& c) { c.target().primitives()[0].type(primitive::PRISM_); }),
                HasSubstr("target.primitives[0].type = 5"));
    EXPECT_THAT(with([](MoveItCall& c) { c.target().primitives()[0].dimensions().pop_back(); }),
                AllOf(HasSubstr("target.primitives[0].dimensions has 2"), HasSubstr("BOX has 3")));
    EXPECT_THAT(with([](MoveItCall& c) { c.target().primitives()[0].dimensions()[1] = 0.0; }),
                HasSubstr("target.primitives[0].dimensions[1] = 0"));
    EXPECT_THAT(with([](MoveItCall& c) { c.target().primitive_poses().resize(2, pose(0, 0, 0)); }),
                HasSubstr("target.primitive_poses has 2"));
    EXPECT_THAT(with([](MoveItCall& c) {
                    c.target().meshes().push_back(
                        write_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}));
                }),
                HasSubstr("target.meshes[0].triangles[0] uses vertex 3 of 3"));
    EXPECT_THAT(with([](MoveItCall& c) { c.support_surfaces().push_back("table"); }),
                HasSubstr("support_surfaces[0] = \"table\""));
    EXPECT_THAT(with([](MoveItCall& c) { c.movable_obstacles().push_back(obstacle("air")); }),
                HasSubstr("movable_obstacles[0] has neither"));
    EXPECT_THAT(with([](MoveItCall& c) {
                    c.movable_obstacles().push_back(obstacle("wall"));
                    c.movable_obstacles()[0].planes().push_back(plane({0, 0, 0, 1}));
                }),
                HasSubstr("movable_obstacles[0].planes[0].coef"));
    EXPECT_THAT(with([](MoveItCall& c) {
                    c.candidate_grasps().resize(1);
                    c.candidate_grasps()[0].grasp_pose().pose(pose(std::nan(""), 0, 0));
                }),
                HasSubstr("candidate_grasps[0].grasp_pose.pose.position"));
    EXPECT_THAT(with([](MoveItCall& c) { c.candidate_grasps().resize(1001); }),
                HasSubstr("candidate_grasps has 1001"));
    EXPECT_THAT(with([](MoveItCall& c) {
                    c.target().primitives().resize(257, c.target().primitives()[0]);
                }),
                HasSubstr("target: meshes and primitives has 257"));
}

TEST(ReadMoveIt, OneFrameForAll) {
    MoveItCall call = box_call();
    EXPECT_TRUE(has_one_frame(call));
    call.movable_obstacles().push_back(obstacle("box"));
    call.movable_obstacles()[0].primitives().push_back(solid(primitive::SPHERE_, {0.1}));
    EXPECT_TRUE(has_one_frame(call));  // empty: the same
    call.movable_obstacles()[0].header().frame_id("camera");
    EXPECT_FALSE(has_one_frame(call));
    EXPECT_THAT(error_of(call), HasSubstr("movable_obstacles[0].header.frame_id = \"camera\""));
    PlanReply reply;
    reply.status = PlanStatus::kInvalidRequest;
    EXPECT_EQ(moveit_verdict(reply, call).val, codes::FRAME_TRANSFORM_FAILURE_);
}

/// One grasp of the second gripper: H at (1, 2, 3), straight down onto the object.
PlanReply one_grasp() {
    PlanReply reply;
    reply.status = PlanStatus::kOk;
    Grasp& grasp = reply.grasps.emplace_back();
    grasp.X_FH.translation() << 1, 2, 3;
    grasp.approach = {-Eigen::Vector3d::UnitZ(), 0.1};
    grasp.retreat = {Eigen::Vector3d::UnitZ(), 0.06};
    grasp.open_width_m = 0.06;
    grasp.width_m = 0.04;
    grasp.score = 0.75;
    grasp.gripper_name = "second";
    return reply;
}

TEST(WriteMoveIt, EveryFieldOfAGrasp) {
    const auto grasps = write_moveit_grasps(one_grasp(), box_call(), settings().hands);
    ASSERT_EQ(grasps.size(), 1u);
    const moveit::Grasp_& grasp = grasps[0];
    EXPECT_EQ(grasp.id(), "grasp_1");
    EXPECT_EQ(grasp.grasp_pose().header().frame_id(), "base");
    EXPECT_EQ(grasp.grasp_pose().header().stamp().sec(), 7);
    EXPECT_EQ(grasp.grasp_pose().pose(), turned(1.0, 2.0, 2.9));
    EXPECT_EQ(grasp.grasp_quality(), 0.75);
    EXPECT_THAT(grasp.pre_grasp_posture().joint_names(), ElementsAre("finger"));
    ASSERT_EQ(grasp.pre_grasp_posture().points().size(), 1u);
    EXPECT_THAT(grasp.pre_grasp_posture().points()[0].positions(), ElementsAre(0.03));
    EXPECT_TRUE(grasp.pre_grasp_posture().points()[0].effort().empty());
    EXPECT_THAT(grasp.grasp_posture().points()[0].positions(), ElementsAre(0.02));
    EXPECT_THAT(grasp.grasp_posture().points()[0].effort(), ElementsAre(20.0));
    EXPECT_EQ(grasp.max_contact_force(), 20.0f);
    EXPECT_THAT(grasp.allowed_touch_objects(), ElementsAre("block"));
    const auto& approach = grasp.pre_grasp_approach();
    EXPECT_EQ(approach.direction().header().frame_id(), "base");
    EXPECT_EQ(approach.direction().vector(), write_vector(-Eigen::Vector3d::UnitZ()));
    EXPECT_EQ(approach.desired_distance(), 0.1f);
    EXPECT_EQ(approach.min_distance(), 0.05f);
    EXPECT_EQ(grasp.post_grasp_retreat().direction().vector(),
              write_vector(Eigen::Vector3d::UnitZ()));
    EXPECT_EQ(grasp.post_grasp_retreat().desired_distance(), 0.06f);
    // The place is not known: back along the hand's own axis, whatever it points to then.
    EXPECT_EQ(grasp.post_place_retreat().direction().header().frame_id(), "wrist");
    EXPECT_EQ(grasp.post_place_retreat().direction().vector().z(), -1.0);
}

TEST(WriteMoveIt, AGripperThatMoveItDoesNotKnowGivesItsMountingFrame) {
    const auto grasps = write_moveit_grasps(one_grasp(), box_call(), {});
    EXPECT_EQ(grasps.at(0).grasp_pose().pose(), pose(1, 2, 3));
    EXPECT_TRUE(grasps[0].grasp_posture().joint_names().empty());
    EXPECT_TRUE(grasps[0].grasp_posture().points().empty());
    EXPECT_EQ(grasps[0].post_place_retreat().direction().header().frame_id(), "base");
}

// A linkage's driver has a torque, which the force on a finger is not.
TEST(WriteMoveIt, ALinkageHasNoEffort) {
    MoveItSettings turning = settings();
    turning.hands[0].joints[0].slides = false;
    const auto grasps = write_moveit_grasps(one_grasp(), box_call(), turning.hands);
    EXPECT_TRUE(grasps.at(0).grasp_posture().points().at(0).effort().empty());
}

TEST(WriteMoveIt, CandidatesKeepTheirIds) {
    MoveItCall call = box_call();
    call.candidate_grasps().resize(2);
    call.candidate_grasps()[1].id("mine");
    PlanReply reply = one_grasp();
    reply.grasps.push_back(reply.grasps[0]);
    reply.grasps[0].candidate = 1;
    reply.grasps[1].candidate = 0;
    const auto grasps = write_moveit_grasps(reply, call, {});
    EXPECT_EQ(grasps.at(0).id(), "mine");
    EXPECT_EQ(grasps.at(1).id(), "grasp_2");
}

TEST(WriteMoveIt, VerdictsOfEveryStatus) {
    const auto verdict = [](PlanStatus status, bool with_grasp) {
        PlanReply reply = one_grasp();
        if (!with_grasp) reply.grasps.clear();
        reply.status = status;
        reply.message = "why";
        return moveit_verdict(reply, box_call()).val;
    };
    EXPECT_EQ(verdict(PlanStatus::kOk, true), 1);
    EXPECT_EQ(verdict(PlanStatus::kOk, false), 99999);  // never an empty success
    EXPECT_EQ(verdict(PlanStatus::kPartial, true), 1);
    EXPECT_EQ(verdict(PlanStatus::kPartial, false), -6);
    EXPECT_EQ(verdict(PlanStatus::kNoGrasp, false), -1);
    EXPECT_EQ(verdict(PlanStatus::kInvalidRequest, false), -19);
    EXPECT_EQ(verdict(PlanStatus::kUnknownGripper, false), -15);
    EXPECT_EQ(verdict(PlanStatus::kCancelled, false), -7);
    EXPECT_EQ(verdict(PlanStatus::kOverloaded, false), 99999);
    EXPECT_EQ(verdict(PlanStatus::kInternalError, false), 99999);
    PlanReply none;
    none.status = PlanStatus::kNoGrasp;
    none.message = "no candidate was found";
    none.report.suggestion = "with friction 1 there is a grasp";
    EXPECT_EQ(moveit_verdict(none, box_call()).message,
              "no candidate was found; with friction 1 there is a grasp");
}

}  // namespace
}  // namespace graspd::dds
