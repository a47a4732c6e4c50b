#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "plan_arguments.hpp"

namespace graspd::cli {
namespace {

using testing::HasSubstr;

const std::filesystem::path kProfiles = GRASPD_SOURCE_DIR "/profiles";

/// An OFF file with a tetrahedron whose lowest point is z = -2, in the file's own unit.
class PlanArgumentsTest : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(file_) << "OFF\n4 4 0\n0 0 -2\n10 0 0\n0 10 0\n0 0 10\n"
                                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
        arguments_.object.file = file_.string();
    }
    void TearDown() override { std::filesystem::remove(file_); }

    PlanArguments arguments_;

private:
    const std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) / ("cli_" + std::to_string(getpid()) + ".off");
};

TEST_F(PlanArgumentsTest, BecomeARequestInMetresAndSeconds) {
    arguments_.object.scale = 0.01;
    arguments_.gripper = "franka_hand";
    arguments_.top = 3;
    arguments_.time_budget_ms = 250;
    arguments_.friction = 0.4;
    arguments_.sources = "boundary,whole_object";
    arguments_.seed = 9;
    arguments_.suggest = true;
    arguments_.markers = true;
    arguments_.frame_id = "camera";
    const auto request = make_request(arguments_, kProfiles);
    ASSERT_TRUE(request.ok()) << request.error().detail;
    const auto& mesh = std::get<TriangleMesh>(request.value().object_O);
    EXPECT_NEAR(mesh.vertices[1].x(), 0.1, 1e-15);
    ASSERT_EQ(request.value().grippers.size(), 1u);
    EXPECT_EQ(request.value().grippers[0].name, "franka_hand");
    EXPECT_EQ(request.value().options.max_grasps, 3u);
    EXPECT_EQ(request.value().options.time_budget_s, 0.25);
    EXPECT_EQ(request.value().options.friction, 0.4);
    EXPECT_EQ(request.value().options.sources, kBoundary | kWholeObject);
    EXPECT_EQ(request.value().options.seed, 9u);
    EXPECT_TRUE(request.value().options.want_suggestion);
    EXPECT_TRUE(request.value().options.want_markers);
    EXPECT_EQ(request.value().frame_id, "camera");
    EXPECT_FALSE(request.value().support_plane.has_value());
}

// Up along +z: the lowest point is z = -2. Up along -x: x = 10 is lowest, so normal . p = -10.
TEST_F(PlanArgumentsTest, UpPutsAPlaneUnderTheLowestPoint) {
    arguments_.up = "0,0,5";
    auto request = make_request(arguments_, kProfiles);
    ASSERT_TRUE(request.ok()) << request.error().detail;
    ASSERT_TRUE(request.value().support_plane.has_value());
    EXPECT_EQ(request.value().support_plane->normal_F, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(request.value().support_plane->offset_m, -2.0);
    arguments_.up = "-1,0,0";
    request = make_request(arguments_, kProfiles);
    ASSERT_TRUE(request.ok());
    EXPECT_EQ(request.value().support_plane->offset_m, -10.0);
}

TEST_F(PlanArgumentsTest, WrongOnesAreNamedWithTheirValue) {
    const auto detail = [&] {
        const auto request = make_request(arguments_, kProfiles);
        EXPECT_FALSE(request.ok());
        return request.ok() ? std::string() : request.error().detail;
    };
    for (const char* up : {"0,0", "0,0,0", "0,0,up", "0,0,1,0", "nan,0,1", ""}) {
        arguments_.up = up;
        EXPECT_THAT(detail(), HasSubstr(std::string("--up = ") + up + " must be")) << up;
    }
    arguments_.up = "none";
    arguments_.sources = "boundary,rim";
    EXPECT_THAT(detail(), HasSubstr("--sources = boundary,rim must be"));
    arguments_.sources = "all";
    arguments_.gripper = "hook";
    EXPECT_THAT(detail(), HasSubstr("gripper = hook is unknown"));
    arguments_.gripper = "parallel_85";
    arguments_.object.file = "/nowhere/mug.stl";
    EXPECT_THAT(detail(), HasSubstr("/nowhere/mug.stl"));
}

TEST_F(PlanArgumentsTest, SourcesAreBits) {
    EXPECT_EQ(parse_sources("all").value(), kAllSources);
    EXPECT_EQ(parse_sources("wall").value(), kWall);
    EXPECT_EQ(parse_sources("boundary,wall,whole_object").value(), kAllSources);
    EXPECT_FALSE(parse_sources("").ok());
}

}  // namespace
}  // namespace graspd::cli
