#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "exit_code.hpp"
#include "graspd/config/version.hpp"
#include "text_table.hpp"
#include "write_json.hpp"
#include "write_table.hpp"

namespace graspd::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Gx = y, Gy = z, Gz = x: every column is told from every row.
Eigen::Isometry3d cyclic_pose() {
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();
    X_FG.linear().col(0) = Eigen::Vector3d::UnitY();
    X_FG.linear().col(1) = Eigen::Vector3d::UnitZ();
    X_FG.linear().col(2) = Eigen::Vector3d::UnitX();
    X_FG.translation() = Eigen::Vector3d(0.1 + 0.2, -1.0 / 3.0, 5e-324);
    return X_FG;
}

Gripper named_gripper(const std::string& name) {
    Gripper gripper;
    gripper.name = name;
    return gripper;
}

PlanReply one_grasp() {
    Grasp grasp;
    grasp.X_FG = cyclic_pose();
    grasp.approach = {Eigen::Vector3d::UnitX(), 0.1};
    grasp.retreat = {-Eigen::Vector3d::UnitX(), 0.05};
    grasp.width_m = 0.0345;
    grasp.open_width_m = 0.045;
    grasp.contacts = {Contact{{0, 0.01, 0}, {0, -1, 0}}, Contact{{0, 0.04, 0}, {0, 1, 0}}};
    grasp.gripper_name = "second";
    grasp.concavity_index = 2;
    grasp.concavity_depth_m = 0.03;
    grasp.clearance_m = std::numeric_limits<double>::infinity();
    grasp.beta_rad = 0.25;
    grasp.min_friction = 0.125;
    grasp.min_force_N = 3.0;
    grasp.score = 0.75;
    grasp.terms = {{"bias", 0.5}, {"beta", -0.25}};
    grasp.source = kWall;
    PlanReply reply;
    reply.request_id = "mug \"7\"";
    reply.frame_id = "table";
    reply.object_key = "00ff";
    reply.status = PlanStatus::kOk;
    reply.strategy = "concavity";
    reply.grasps = {grasp};
    reply.report.stages = {{"mesh/condition_mesh", 1.5, 10, 12}};
    reply.report.rejections = {{"palm_collision", 7}, {"too_wide", 3}};
    reply.report.near_misses = {{cyclic_pose(), "too_wide", 0.002, "m"}};
    reply.report.findings = {{"holes_filled", 2, "two holes were filled"}};
    reply.report.suggestion = "open by 3 mm more";
    return reply;
}

json parsed(const PlanReply& reply) {
    const std::vector<Gripper> grippers = {named_gripper("first"), named_gripper("second")};
    return json::parse(write_json(reply, grippers, {"0.1.0", "abcd", 12.5}));
}

// The members that DESIGN promises to scripts, by name and type.
TEST(WriteJson, HasEveryPromisedMember) {
    const json reply = parsed(one_grasp());
    EXPECT_EQ(reply["schema"], "graspd/1");
    EXPECT_EQ(reply["request_id"], "mug \"7\"");
    EXPECT_EQ(reply["status"], "OK");
    EXPECT_EQ(reply["message"], "");
    EXPECT_EQ(reply["frame_id"], "table");
    EXPECT_EQ(reply["strategy"], "concavity");
    EXPECT_EQ(reply["convention"], "tcp_z_approach_x_closing");
    for (const char* key : {"max_width", "finger_length", "finger_width", "finger_thickness",
                            "palm_depth", "palm_width", "palm_height", "tip_offset"}) {
        EXPECT_TRUE(reply["gripper"][key].is_number()) << key;
    }
    const json& grasp = reply["grasps"][0];
    EXPECT_EQ(grasp["rank"], 1);
    EXPECT_EQ(grasp["width"], 0.0345);
    EXPECT_EQ(grasp["open_width"], 0.045);
    EXPECT_EQ(grasp["score"], 0.75);
    EXPECT_EQ(grasp["terms"], json({{"bias", 0.5}, {"beta", -0.25}}));
    EXPECT_EQ(grasp["approach"], json({{"direction", {1.0, 0.0, 0.0}}, {"distance", 0.1}}));
    EXPECT_EQ(grasp["retreat"]["distance"], 0.05);
    EXPECT_EQ(grasp["contacts"][1]["point"], json({0.0, 0.04, 0.0}));
    EXPECT_EQ(grasp["contacts"][1]["normal"], json({0.0, 1.0, 0.0}));
    EXPECT_EQ(grasp["concavity"], json({{"index", 2}, {"depth", 0.03}}));
    EXPECT_TRUE(grasp["hand_pose"]["rotation"].is_array());
    EXPECT_EQ(grasp["beta_rad"], 0.25);
    EXPECT_EQ(grasp["min_friction"], 0.125);
    EXPECT_EQ(grasp["source"], "wall");
    const json& report = reply["report"];
    EXPECT_EQ(report["stages"][0],
              json({{"name", "mesh/condition_mesh"}, {"ms", 1.5}, {"in", 10}, {"out", 12}}));
    EXPECT_EQ(report["rejections"], json({{"palm_collision", 7}, {"too_wide", 3}}));
    EXPECT_EQ(report["near_misses"][0]["reason"], "too_wide");
    EXPECT_EQ(report["findings"][0]["code"], "holes_filled");
    EXPECT_EQ(report["suggestion"], "open by 3 mm more");
    EXPECT_EQ(reply["timings_ms"]["total"], 12.5);
}

// Row-major with the columns Gx = (0 1 0), Gy = (0 0 1), Gz = (1 0 0): the rows are (0 0 1),
// (1 0 0), (0 1 0). The same turn is a third of a revolution about (1 1 1): q = (1 1 1 1)/2.
TEST(WriteJson, RotationIsRowMajorWithTheAxesAsColumns) {
    const json pose = parsed(one_grasp())["grasps"][0];
    EXPECT_EQ(pose["rotation"], json({0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}));
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(pose["quaternion"][i].get<double>(), 0.5, 1e-15);
}

// A turn by 350 degrees about z is one by -10 degrees: (0 0 -sin 5 deg, cos 5 deg).
TEST(WriteJson, QuaternionHasXyzwOrderAndItsWIsNotNegative) {
    PlanReply reply = one_grasp();
    constexpr double kDegree = 0.017453292519943295;
    reply.grasps[0].X_FG.linear() =
        Eigen::AngleAxisd(350 * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const json quaternion = parsed(reply)["grasps"][0]["quaternion"];
    EXPECT_NEAR(quaternion[2].get<double>(), -0.08715574274765817, 1e-15);
    EXPECT_NEAR(quaternion[3].get<double>(), 0.9961946980917455, 1e-15);
}

TEST(WriteJson, NumbersReadBackBitForBit) {
    const json position = parsed(one_grasp())["grasps"][0]["position"];
    EXPECT_EQ(position[0].get<double>(), 0.1 + 0.2);
    EXPECT_EQ(position[1].get<double>(), -1.0 / 3.0);
    EXPECT_EQ(position[2].get<double>(), 5e-324);
}

TEST(WriteJson, AnInfiniteNumberIsNull) {
    EXPECT_TRUE(parsed(one_grasp())["grasps"][0]["clearance"].is_null());
}

TEST(WriteJson, GripperIsTheBestGraspsElseTheFirst) {
    PlanReply reply = one_grasp();
    EXPECT_EQ(parsed(reply)["gripper"]["name"], "second");
    reply.grasps.clear();
    EXPECT_EQ(parsed(reply)["gripper"]["name"], "first");
    EXPECT_TRUE(parsed(reply)["grasps"].is_array());
}

TEST(WriteJson, TextThatIsNoUtf8DoesNotEndTheProgram) {
    PlanReply reply = one_grasp();
    reply.request_id = "a\xff";
    EXPECT_EQ(parsed(reply)["request_id"], "a\xef\xbf\xbd");
}

TEST(WriteJson, ListsGrippers) {
    const std::vector<Gripper> grippers = {named_gripper("first"), named_gripper("second")};
    const json list = json::parse(write_json(grippers));
    EXPECT_EQ(list["schema"], "graspd/1");
    EXPECT_EQ(list["grippers"].size(), 2u);
    EXPECT_EQ(list["grippers"][1]["name"], "second");
}

TEST(WriteTable, ShowsMillimetresDegreesAndTheApproach) {
    const std::string table = write_table(one_grasp(), {}, {"0.1.0", "", 12.5});
    EXPECT_THAT(table, HasSubstr("OK, 1 grasps, strategy concavity, 12.5 ms"));
    EXPECT_THAT(table, HasSubstr("0.750   34.5  45.0"));         // score, width, open
    EXPECT_THAT(table, HasSubstr("14.3  0.12  wall"));           // 0.25 rad, mu, source
    EXPECT_THAT(table, HasSubstr("  300.0  -333.3     0.0"));    // TCP
    EXPECT_THAT(table, HasSubstr("   1.00    0.00    0.00\n"));  // Gz
    EXPECT_THAT(table, HasSubstr("mesh/condition_mesh  1.50  10   12\n"));
    EXPECT_THAT(table, testing::Not(HasSubstr("rejected because")));
}

TEST(WriteTable, GivesTheReasonsWhenThereIsNoGrasp) {
    PlanReply reply = one_grasp();
    reply.status = PlanStatus::kNoGrasp;
    reply.message = "no candidate fits";
    reply.grasps.clear();
    const std::string table = write_table(reply, {}, {"0.1.0", "", 1.0});
    EXPECT_THAT(table, HasSubstr("no candidate fits\n"));
    EXPECT_THAT(table, HasSubstr("palm_collision             7\n"));
    EXPECT_THAT(table, HasSubstr("too_wide        2.00 mm"));
    EXPECT_THAT(table, HasSubstr("suggestion: open by 3 mm more\n"));
    EXPECT_THAT(table, HasSubstr("finding: holes_filled: two holes were filled\n"));
}

TEST(TextTable, AlignsColumnsWithoutTrailingBlanks) {
    EXPECT_EQ(print_table({{{"name", "n"}, {"a", "12"}, {"bcdef", "3"}}, {true, false}}),
              "name    n\na      12\nbcdef   3\n");
    EXPECT_EQ(fixed(-0.00001, 1), "0.0");
    EXPECT_EQ(fixed(-0.06, 1), "-0.1");
}

// DESIGN, section 6: OK, or PARTIAL with grasps 0; NO_GRASP, or PARTIAL without 3; INVALID_REQUEST,
// UNKNOWN_*, usage 2; no reply, OVERLOADED, CANCELLED 4; INTERNAL_ERROR 1.
TEST(ExitCode, IsThatOfTheTable) {
    PlanReply with = one_grasp();
    PlanReply without;
    const auto code = [](PlanReply& reply, PlanStatus status) {
        reply.status = status;
        return exit_code(reply);
    };
    EXPECT_EQ(code(with, PlanStatus::kOk), 0);
    EXPECT_EQ(code(with, PlanStatus::kPartial), 0);
    EXPECT_EQ(code(without, PlanStatus::kPartial), 3);
    EXPECT_EQ(code(without, PlanStatus::kNoGrasp), 3);
    EXPECT_EQ(code(without, PlanStatus::kInvalidRequest), 2);
    EXPECT_EQ(code(without, PlanStatus::kUnknownObject), 2);
    EXPECT_EQ(code(without, PlanStatus::kUnknownGripper), 2);
    EXPECT_EQ(code(without, PlanStatus::kOverloaded), 4);
    EXPECT_EQ(code(without, PlanStatus::kCancelled), 4);
    EXPECT_EQ(code(without, PlanStatus::kInternalError), 1);
    EXPECT_EQ(exit_code(PlanError{PlanErrorCode::kUnreadableFile, ""}), 2);
    EXPECT_EQ(exit_code(PlanError{PlanErrorCode::kInternal, ""}), 1);
}

}  // namespace
}  // namespace graspd::cli
