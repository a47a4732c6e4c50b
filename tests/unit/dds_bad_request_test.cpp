#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "convert_cloud.hpp"
#include "convert_request.hpp"
#include "support/plan_samples.hpp"

namespace graspd::dds {
namespace {

using testing::HasSubstr;

const double kNotANumber = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

struct BadField {
    const char* name;
    std::function<void(wire::GraspRequest_&)> spoil;  ///< from a good request with every field set
    std::vector<std::string> says;                    ///< field and value
    PlanErrorCode code = PlanErrorCode::kInvalidInput;
};

void PrintTo(const BadField& bad, std::ostream* out) {
    *out << bad.name;
}

class BadRequest : public testing::TestWithParam<BadField> {};

TEST_P(BadRequest, IsRefusedNamingFieldAndValue) {
    wire::GraspRequest_ request = write_request(test::full_request(), "client").value();
    ASSERT_TRUE(read_request(request, {}).ok());
    GetParam().spoil(request);
    const auto read = read_request(request, {});
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().code, GetParam().code) << read.error().detail;
    for (const std::string& part : GetParam().says) {
        EXPECT_THAT(read.error().detail, HasSubstr(part));
    }
}

const auto kUnsupported = PlanErrorCode::kUnsupported;
using Wire = wire::GraspRequest_;

const BadField kBadFields[] = {
    {"EmptyId", [](Wire& r) { r.request_id(""); }, {"request_id", "0 characters"}},
    {"LongId",
     [](Wire& r) { r.request_id(std::string(65, 'x')); },
     {"request_id", "65 characters", "1 to 64"}},
    {"LineBreakInId", [](Wire& r) { r.request_id("a\nb"); }, {"request_id", "\"a?b\""}},
    {"AccentInId", [](Wire& r) { r.request_id("caf\xc3\xa9"); }, {"request_id", "\"caf??\""}},
    {"NulInId", [](Wire& r) { r.request_id(std::string("a\0b", 3)); }, {"request_id"}},
    {"LongClient", [](Wire& r) { r.client_id(std::string(65, 'x')); }, {"client_id", "65"}},
    {"BadClient", [](Wire& r) { r.client_id("\x7f"); }, {"client_id", "printable"}},
    {"LongKey", [](Wire& r) { r.object_key(std::string(65, 'x')); }, {"object_key", "65"}},
    {"LongFrame", [](Wire& r) { r.header().frame_id(std::string(257, 'x')); }, {"frame_id", "257"}},
    {"BadFrame", [](Wire& r) { r.header().frame_id("a\tb"); }, {"header.frame_id", "\"a?b\""}},
    {"NoObject", [](Wire& r) { r.mesh({}); }, {"mesh, cloud and object_key", "none"}},
    {"MeshAndKey", [](Wire& r) { r.object_key("k"); }, {"exactly one", "mesh object_key"}},
    {"MeshAndCloud",
     [](Wire& r) {
         FirstError none;
         r.cloud(write_cloud({{1, 2, 3}}, none));
     },
     {"exactly one", "mesh cloud"}},
    {"SensorWithoutCloud", [](Wire& r) { r.sensor_origin().resize(1); }, {"sensor_origin"}},
    {"TwoPoses", [](Wire& r) { r.object_pose().resize(2); }, {"object_pose", "2", "at most 1"}},
    {"ZeroQuaternion",
     [](Wire& r) { r.object_pose()[0].orientation({}); },
     {"object_pose[0].orientation", "length 0"}},
    {"LongQuaternion",
     [](Wire& r) {
         r.object_pose()[0].orientation({});
         r.object_pose()[0].orientation().w(1.002);
     },
     {"object_pose[0].orientation", "1.002"}},
    {"NaNQuaternion",
     [](Wire& r) { r.object_pose()[0].orientation().x(kNotANumber); },
     {"object_pose[0].orientation", "nan"}},
    {"InfinitePosition",
     [](Wire& r) { r.object_pose()[0].position().y(-kInfinity); },
     {"object_pose[0].position", "-inf"}},
    {"NoGripper", [](Wire& r) { r.grippers().clear(); }, {"gripper", "grippers has 0"}},
    {"BothGrippers", [](Wire& r) { r.gripper("x"); }, {"gripper = \"x\"", "grippers has 2"}},
    {"NineGrippers", [](Wire& r) { r.grippers().resize(9); }, {"grippers has 9", "8"}},
    {"SameGripperNames",
     [](Wire& r) { r.grippers()[1].name("parallel_85"); },
     {"grippers[1].name", "parallel_85"}},
    {"NamelessGripper", [](Wire& r) { r.grippers()[1].name(""); }, {"grippers[1].name"}},
    {"ZeroGripper",
     [](Wire& r) { r.grippers()[0].max_width(0); },
     {"grippers[0]", "max_width = 0"}},
    {"NaNGripper",
     [](Wire& r) { r.grippers()[1].palm_depth(kNotANumber); },
     {"grippers[1]", "palm_depth"}},
    {"FallingTravel",
     [](Wire& r) { r.grippers()[1].pad_travel()[1].opening(0.001); },
     {"grippers[1]", "pad_travel"}},
    {"LongTravel",
     [](Wire& r) { r.grippers()[1].pad_travel().resize(65); },
     {"grippers[1].pad_travel", "65"}},
    {"EmptyPart",
     [](Wire& r) { r.grippers()[0].palm_meshes().resize(2); },
     {"grippers[0].palm_meshes[0]", "0 points"}},
    {"FlatPart",
     [](Wire& r) {
         r.grippers()[0].finger_left_meshes().push_back(
             write_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}}));
     },
     {"grippers[0].finger_left_meshes[0]", "4 points", "one plane"}},
    {"NaNPart",
     [](Wire& r) {
         r.grippers()[0].finger_right_meshes().push_back(
             write_mesh({{{0, 0, 0}, {1, 0, 0}, {0, kNotANumber, 0}, {1, 1, 1}}, {}}));
     },
     {"grippers[0].finger_right_meshes[0]", "not finite"}},
    {"ManyParts",
     [](Wire& r) { r.grippers()[0].palm_meshes().resize(17); },
     {"grippers[0].palm_meshes has 17", "16"}},
    {"TwoPlanes", [](Wire& r) { r.support_plane().resize(2); }, {"support_plane", "2"}},
    {"ShortNormal",
     [](Wire& r) {
         r.support_plane()[0].normal(write_vector({0, 0, 0.998}));
     },
     {"support_plane[0].normal", "0.998"}},
    {"NaNOffset",
     [](Wire& r) { r.support_plane()[0].offset(kNotANumber); },
     {"support_plane[0].offset", "nan"}},
    {"ManyObstacles", [](Wire& r) { r.obstacles().resize(65); }, {"obstacles has 65", "64"}},
    {"EmptyObstacle", [](Wire& r) { r.obstacles()[1].mesh({}); }, {"obstacles[1].mesh"}},
    {"ObstacleQuaternion",
     [](Wire& r) { r.obstacles()[1].pose().orientation({}); },
     {"obstacles[1].pose.orientation", "length 0"}},
    {"ObstaclePosition",
     [](Wire& r) { r.obstacles()[0].pose().position().x(kNotANumber); },
     {"obstacles[0].pose.position", "nan"}},
    {"ObstacleCloud",
     [](Wire& r) {
         FirstError none;
         r.obstacle_cloud(write_cloud({{1, 2, 3}}, none));
     },
     {"obstacle_cloud", "1 x 1"},
     kUnsupported},
    {"ManyCones", [](Wire& r) { r.approach_cones().resize(65); }, {"approach_cones has 65"}},
    {"ZeroAxis", [](Wire& r) { r.approach_cones()[1].axis({}); }, {"approach_cones[1].axis", "0"}},
    {"ZeroCone",
     [](Wire& r) { r.approach_cones()[0].half_angle(0); },
     {"approach_cones[0].half_angle = 0", "(0, 3.14159265]"}},
    {"WideCone", [](Wire& r) { r.approach_cones()[0].half_angle(3.2); }, {"half_angle = 3.2"}},
    {"ManyBoxes", [](Wire& r) { r.keep_out_boxes().resize(65); }, {"keep_out_boxes has 65"}},
    {"FlatBox", [](Wire& r) { r.keep_out_boxes()[0].size().y(0); }, {"keep_out_boxes[0].size"}},
    {"NaNBox",
     [](Wire& r) { r.keep_out_boxes()[0].size().x(kNotANumber); },
     {"keep_out_boxes[0].size"}},
    {"BoxPose",
     [](Wire& r) { r.keep_out_boxes()[0].pose().orientation({}); },
     {"keep_out_boxes[0].pose.orientation"}},
    {"TwoOptions", [](Wire& r) { r.options().resize(2); }, {"options has 2"}},
    {"ManyGrasps",
     [](Wire& r) { r.options()[0].max_grasps(1001); },
     {"options[0].max_grasps = 1001", "1000"}},
    {"NegativeBudget",
     [](Wire& r) { r.options()[0].time_budget(-1); },
     {"options[0].time_budget = -1"}},
    {"EndlessBudget",
     [](Wire& r) { r.options()[0].time_budget(3601); },
     {"options[0].time_budget = 3601"}},
    {"NoFriction",
     [](Wire& r) { r.options()[0].friction(0); },
     {"options[0].friction = 0", "(0, 10]"}},
    {"NaNFriction",
     [](Wire& r) { r.options()[0].friction(kNotANumber); },
     {"options[0].friction = nan"}},
    {"NegativeClearance",
     [](Wire& r) { r.options()[0].min_clearance(-0.001); },
     {"options[0].min_clearance = -0.001"}},
    {"TwoMasses",
     [](Wire& r) {
         r.options()[0].mass({1, 2});
     },
     {"options[0].mass has 2"}},
    {"NoMass", [](Wire& r) { r.options()[0].mass({0}); }, {"options[0].mass[0] = 0"}},
    {"InfiniteMass", [](Wire& r) { r.options()[0].mass({kInfinity}); }, {"mass[0] = inf"}},
    {"TwoCentres",
     [](Wire& r) { r.options()[0].center_of_mass().resize(2); },
     {"options[0].center_of_mass has 2"}},
    {"NaNCentre",
     [](Wire& r) { r.options()[0].center_of_mass()[0].z(kNotANumber); },
     {"options[0].center_of_mass[0]", "nan"}},
    {"TwoForces",
     [](Wire& r) {
         r.options()[0].grip_force({1, 2});
     },
     {"grip_force has 2"}},
    {"NoForce", [](Wire& r) { r.options()[0].grip_force({0}); }, {"grip_force[0] = 0"}},
    {"UnknownSource", [](Wire& r) { r.options()[0].sources(8); }, {"options[0].sources = 8"}},
    {"ConcavityField",
     [](Wire& r) { r.options()[0].concavity_field(true); },
     {"options[0].concavity_field = true"},
     kUnsupported},
};

INSTANTIATE_TEST_SUITE_P(ConvertRequest, BadRequest, testing::ValuesIn(kBadFields),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace graspd::dds
