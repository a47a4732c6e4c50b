#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "cli_export_samples.hpp"
#include "grasp_conventions.hpp"
#include "yaml_text.hpp"

namespace graspd::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

GraspFile sample_file() {
    auto file = read_grasps(sample_json());
    EXPECT_TRUE(file.ok());
    return std::move(file).value();
}

const std::vector<ExportHand> kHands = {sample_hand()};

/// What a writer returned; empty after a failure.
std::string text_of(const Result<std::string>& result) {
    EXPECT_TRUE(result.ok()) << result.error().detail;
    return result.ok() ? result.value() : "";
}

Eigen::Vector3d vector_of(const YAML::Node& node) {
    return {node["x"].as<double>(), node["y"].as<double>(), node["z"].as<double>()};
}

Eigen::Isometry3d pose_of(const Eigen::Vector3d& position, const Eigen::Quaterniond& turn) {
    Eigen::Isometry3d pose(turn);
    pose.translation() = position;
    return pose;
}

Eigen::Isometry3d moveit_pose(const YAML::Node& message) {
    const YAML::Node pose = message["grasp_pose"]["pose"];
    const YAML::Node turn = pose["orientation"];
    return pose_of(vector_of(pose["position"]), {turn["w"].as<double>(), turn["x"].as<double>(),
                                                 turn["y"].as<double>(), turn["z"].as<double>()});
}

Eigen::Isometry3d isaac_pose(const YAML::Node& grasp) {
    const auto at = grasp["position"].as<std::vector<double>>();
    const auto xyz = grasp["orientation"]["xyz"].as<std::vector<double>>();
    return pose_of({at[0], at[1], at[2]},
                   {grasp["orientation"]["w"].as<double>(), xyz[0], xyz[1], xyz[2]});
}

Eigen::Isometry3d gpd_pose(const YAML::Node& grasp) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << vector_of(grasp["approach"]), vector_of(grasp["binormal"]),
        vector_of(grasp["axis"]);
    pose.translation() = vector_of(grasp["position"]);
    return pose;
}

Eigen::Isometry3d graspgen_pose(const json& rows) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (Eigen::Index i = 0; i < 16; ++i) {
        pose.matrix()(i / 4, i % 4) =
            rows[static_cast<std::size_t>(i / 4)][static_cast<std::size_t>(i % 4)].get<double>();
    }
    return pose;
}

void expect_near(const Eigen::Isometry3d& got, const Eigen::Isometry3d& want) {
    EXPECT_LT((got.matrix() - want.matrix()).cwiseAbs().maxCoeff(), 1e-12)
        << got.matrix() << "\ninstead of\n"
        << want.matrix();
}

std::vector<double> doubles(const YAML::Node& node) {
    return node.as<std::vector<double>>();
}

using Doubles = std::vector<double>;

// The link "wrist": its axes are -y, -x, -z of F, its origin 0.16 above the TCP at z = 0.3. Of the
// rotation with these columns the quaternion (x y z w) is (1 -1 0 0) / sqrt 2: a half turn about
// (1 -1 0), which takes x to -y, y to -x and z to -z.
TEST(WriteMoveIt, PoseOfTheParentLinkFromAbove) {
    const auto documents = YAML::LoadAll(text_of(write_moveit_yaml(sample_file(), kHands, {})));
    ASSERT_EQ(documents.size(), 2u);
    const YAML::Node message = documents[0];
    const YAML::Node pose = message["grasp_pose"]["pose"];
    EXPECT_TRUE(vector_of(pose["position"]).isApprox(Eigen::Vector3d(0.1, 0.2, 0.46), 1e-12));
    const double x = pose["orientation"]["x"].as<double>();
    EXPECT_NEAR(std::abs(x), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(pose["orientation"]["y"].as<double>(), -x, 1e-12);
    EXPECT_NEAR(pose["orientation"]["z"].as<double>(), 0.0, 1e-12);
    EXPECT_NEAR(pose["orientation"]["w"].as<double>(), 0.0, 1e-12);
    EXPECT_EQ(message["grasp_pose"]["header"]["frame_id"].as<std::string>(), "table");
}

// Half the opening: 0.025 before, 0.01 at the grasp. Lz is the approach, so the way back is -Lz.
TEST(WriteMoveIt, FillsEveryFieldOfTheMessage) {
    const YAML::Node message =
        YAML::LoadAll(text_of(write_moveit_yaml(sample_file(), kHands, {})))[0];
    EXPECT_EQ(message.size(), 10u);
    EXPECT_EQ(message["id"].as<std::string>(), "grasp_1");
    const YAML::Node open = message["pre_grasp_posture"], closed = message["grasp_posture"];
    EXPECT_EQ(open["joint_names"].as<std::vector<std::string>>(),
              (std::vector<std::string>{"left_finger", "right_finger"}));
    EXPECT_EQ(doubles(open["points"][0]["positions"]), (Doubles{0.025, 0.025}));
    EXPECT_EQ(doubles(closed["points"][0]["positions"]), (Doubles{0.01, 0.01}));
    EXPECT_EQ(doubles(open["points"][0]["effort"]), Doubles());
    EXPECT_EQ(doubles(closed["points"][0]["effort"]), (Doubles{20.0, 20.0}));
    EXPECT_EQ(message["grasp_quality"].as<double>(), 0.75);
    const YAML::Node approach = message["pre_grasp_approach"];
    EXPECT_EQ(vector_of(approach["direction"]["vector"]), Eigen::Vector3d(0, 0, -1));
    EXPECT_EQ(approach["direction"]["header"]["frame_id"].as<std::string>(), "table");
    EXPECT_EQ(approach["desired_distance"].as<double>(), 0.1);
    EXPECT_EQ(approach["min_distance"].as<double>(), 0.05);
    const YAML::Node retreat = message["post_grasp_retreat"];
    EXPECT_EQ(vector_of(retreat["direction"]["vector"]), Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(retreat["desired_distance"].as<double>(), 0.08);
    const YAML::Node release = message["post_place_retreat"];
    EXPECT_EQ(release["direction"]["header"]["frame_id"].as<std::string>(), "wrist");
    EXPECT_EQ(vector_of(release["direction"]["vector"]), Eigen::Vector3d(0, 0, -1));
    EXPECT_EQ(message["max_contact_force"].as<double>(), 20.0);
    EXPECT_EQ(message["allowed_touch_objects"][0].as<std::string>(), "mug");
}

// "tool0" 0.1 behind H, turned by 90 degrees about Hy: Lz = Hx = y, Lx = -Hz = z; the approach
// -z is -Lx. H is at z = 0.44.
TEST(WriteMoveIt, TakesAnotherLink) {
    ExportOptions options;
    options.object = "cup_7";
    options.link = "tool0";
    options.X_HL = Eigen::Translation3d(0, 0, -0.1) *
                   Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitY());
    const YAML::Node message =
        YAML::LoadAll(text_of(write_moveit_yaml(sample_file(), kHands, options)))[0];
    const Eigen::Isometry3d X_FL = moveit_pose(message);
    EXPECT_TRUE(X_FL.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.54), 1e-12));
    EXPECT_TRUE(X_FL.linear().col(0).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
    EXPECT_TRUE(X_FL.linear().col(2).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
    const YAML::Node direction = message["post_place_retreat"]["direction"];
    EXPECT_EQ(direction["header"]["frame_id"].as<std::string>(), "tool0");
    EXPECT_TRUE(vector_of(direction["vector"]).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
    EXPECT_EQ(message["allowed_touch_objects"][0].as<std::string>(), "cup_7");
}

TEST(WriteIsaacGrasp, IsTheFileOfTheSpecification) {
    const YAML::Node file = YAML::Load(text_of(write_isaac_grasp(sample_file(), kHands, {})));
    EXPECT_EQ(file["format"].as<std::string>(), "isaac_grasp");
    EXPECT_EQ(file["format_version"].as<double>(), 1.0);
    EXPECT_EQ(file["object_frame_link"].as<std::string>(), "table");
    EXPECT_EQ(file["gripper_frame_link"].as<std::string>(), "hand");
    EXPECT_EQ(file["object_scale"].as<double>(), 1.0);
    ASSERT_EQ(file["grasps"].size(), 2u);
    const YAML::Node grasp = file["grasps"]["grasp_0"];
    EXPECT_EQ(grasp["confidence"].as<double>(), 0.75);
    EXPECT_EQ(grasp["cspace_position"]["left_finger"].as<double>(), 0.01);
    EXPECT_EQ(grasp["pregrasp_cspace_position"]["right_finger"].as<double>(), 0.025);
    // H: Hx = y, Hy = x, Hz = -z at (0.1, 0.2, 0.44).
    Eigen::Isometry3d by_hand = Eigen::Isometry3d::Identity();
    by_hand.matrix() << 0, 1, 0, 0.1, 1, 0, 0, 0.2, 0, 0, -1, 0.44, 0, 0, 0, 1;
    expect_near(isaac_pose(grasp), by_hand);
}

// Base 40 mm behind the TCP: the tips 10 mm in front of it less fingers of 50 mm.
TEST(WriteGpd, HandFromAbove) {
    const YAML::Node list = YAML::Load(text_of(write_gpd_yaml(sample_file(), kHands, {})));
    EXPECT_EQ(list["header"]["frame_id"].as<std::string>(), "table");
    ASSERT_EQ(list["grasps"].size(), 2u);
    const YAML::Node grasp = list["grasps"][0];
    EXPECT_TRUE(vector_of(grasp["position"]).isApprox(Eigen::Vector3d(0.1, 0.2, 0.34), 1e-12));
    EXPECT_TRUE(vector_of(grasp["approach"]).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
    EXPECT_TRUE(vector_of(grasp["binormal"]).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
    EXPECT_TRUE(vector_of(grasp["axis"]).isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
    EXPECT_EQ(grasp["width"]["data"].as<double>(), 0.02);
    EXPECT_EQ(grasp["score"]["data"].as<double>(), 0.75);
    ExportOptions deeper;
    deeper.hand_depth_m = 0.06;
    const YAML::Node deep = YAML::Load(text_of(write_gpd_yaml(sample_file(), kHands, deeper)));
    EXPECT_NEAR(deep["grasps"][0]["position"]["z"].as<double>(), 0.35, 1e-12);
}

TEST(WriteGraspGen, BaseLinkFromAbove) {
    ExportOptions options;
    options.object = "meshes/mug.obj";
    options.object_scale = 0.001;
    const json file = json::parse(text_of(write_graspgen_json(sample_file(), options)));
    EXPECT_EQ(file["object"], json({{"file", "meshes/mug.obj"}, {"scale", 0.001}}));
    EXPECT_EQ(file["grasps"]["object_in_gripper"], json({true, true}));
    Eigen::Isometry3d by_hand = Eigen::Isometry3d::Identity();
    by_hand.matrix() << 1, 0, 0, 0.1, 0, -1, 0, 0.2, 0, 0, -1, 0.44, 0, 0, 0, 1;
    expect_near(graspgen_pose(file["grasps"]["transforms"][0]), by_hand);
}

// Each export, read back by another parser, gives our pose again, of both grasps.
TEST(Exports, GoThereAndBack) {
    const Gripper gripper = sample_gripper();
    const GraspFile file = sample_file();
    ExportOptions options;
    options.object = "mug.obj";
    const auto messages = YAML::LoadAll(text_of(write_moveit_yaml(file, kHands, options)));
    const YAML::Node isaac = YAML::Load(text_of(write_isaac_grasp(file, kHands, options)));
    const YAML::Node gpd = YAML::Load(text_of(write_gpd_yaml(file, kHands, options)));
    const json graspgen = json::parse(text_of(write_graspgen_json(file, options)));
    for (std::size_t i = 0; i < 2; ++i) {
        const Grasp grasp = i == 0 ? grasp_from_above() : crooked_grasp();
        const Eigen::Isometry3d X_HG = grasp_in_hand(gripper, grasp.width_m);
        expect_near(link_to_tcp(moveit_pose(messages[i]), X_HG, sample_hand().moveit.X_HP),
                    grasp.X_FG);
        expect_near(link_to_tcp(isaac_pose(isaac["grasps"]["grasp_" + std::to_string(i)]), X_HG,
                                Eigen::Isometry3d::Identity()),
                    grasp.X_FG);
        const double base_z_m =
            gpd_base_z_G_m(gripper, grasp.width_m, grasp.open_width_m, gripper.finger_length_m);
        expect_near(gpd_to_tcp(gpd_pose(gpd["grasps"][i]), base_z_m), grasp.X_FG);
        expect_near(graspgen_to_tcp(graspgen_pose(graspgen["grasps"]["transforms"][i]),
                                    pad_z_m(gripper, grasp.width_m)),
                    grasp.X_FG);
    }
}

TEST(WriteCsv, HasACellForEveryColumn) {
    const std::string text = write_grasp_csv(sample_file());
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    ASSERT_EQ(rows.size(), 3u);
    const auto cell = [&](const std::string& name, std::size_t row) {
        const auto column = std::ranges::find(rows[0], name) - rows[0].begin();
        return rows[row].at(static_cast<std::size_t>(column));
    };
    EXPECT_EQ(rows[1].size(), rows[0].size());
    EXPECT_EQ(rows[2].size(), rows[0].size());
    EXPECT_EQ(cell("rank", 2), "2");
    EXPECT_EQ(cell("gripper", 1), "hand");
    EXPECT_EQ(cell("source", 1), "wall");
    EXPECT_EQ(cell("z_m", 1), "0.3");
    EXPECT_EQ(cell("qx", 1), "1");  // a half turn about x
    EXPECT_EQ(cell("width_m", 1), "0.02");
    EXPECT_EQ(cell("open_width_m", 1), "0.05");
    EXPECT_EQ(cell("approach_distance_m", 1), "0.1");
    EXPECT_EQ(cell("contact_right_x_m", 1), "0.11");
    EXPECT_EQ(cell("clearance_m", 1), "inf");
    EXPECT_EQ(cell("tolerance_shift_m", 1), "0.002");
    EXPECT_EQ(cell("tolerance_shift_m", 2), "");  // not measured
    EXPECT_EQ(cell("hand_z_m", 1), "0.44");
    EXPECT_EQ(cell("term_torque", 1), "-1e-05");
    EXPECT_EQ(std::stod(cell("y_m", 2)), -1.0 / 3.0);
}

// RFC 4180: a cell with a comma or a quote stands in quotes, its quotes doubled.
TEST(WriteCsv, QuotesWhatWouldBreakALine) {
    GraspFile file = sample_file();
    file.grasps[0].gripper_name = "a,\"b\"";
    EXPECT_THAT(write_grasp_csv(file), HasSubstr("\n1,\"a,\"\"b\"\"\",wall,"));
}

// PyYAML reads 1e-05 as a text and 20 as an integer; both must be floats in ROS.
TEST(YamlText, FloatsHaveADecimalPoint) {
    EXPECT_EQ(float_text(1e-5), "1.0e-05");
    EXPECT_EQ(float_text(20.0), "20.0");
    EXPECT_EQ(float_text(-0.1), "-0.1");
    EXPECT_EQ(float_text(1.5e-7), "1.5e-07");
    EXPECT_EQ(float_text(std::numeric_limits<double>::infinity()), ".inf");
}

TEST(YamlText, ANameThatLooksLikeSomethingElseStaysAText) {
    GraspFile file = sample_file();
    file.frame_id = "on";
    EXPECT_THAT(text_of(write_gpd_yaml(file, kHands, {})), HasSubstr("frame_id: \"on\""));
}

TEST(Exports, RefuseWhatTheyCannotSay) {
    GraspFile file = sample_file();
    EXPECT_THAT(write_graspgen_json(file, {}).error().detail, HasSubstr("needs --object FILE"));
    file.grasps[1].gripper_name = "other";
    EXPECT_EQ(write_isaac_grasp(file, kHands, {}).error().detail,
              "grasps[1].gripper = other, but format isaac_grasp is about one gripper, here hand");
    ExportOptions options;
    options.object = "mug.obj";
    EXPECT_THAT(write_graspgen_json(file, options).error().detail,
                HasSubstr("format graspgen is about one gripper"));
    const auto moveit = write_moveit_yaml(file, kHands, {});
    ASSERT_FALSE(moveit.ok());
    EXPECT_EQ(moveit.error().code, PlanErrorCode::kUnknownGripper);
    EXPECT_EQ(moveit.error().detail, "grasps[1].gripper = other, but what is known is hand");
}

}  // namespace
}  // namespace graspd::cli
