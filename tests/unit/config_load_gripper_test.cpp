#include "graspd/config/load_gripper.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "graspd/config/profile_directory.hpp"

namespace graspd {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kGrippers = GRASPD_SOURCE_DIR "/profiles/grippers";

constexpr const char* kComplete =
    "name: test_hand\nmax_width: 0.1\nfinger_length: 0.05\nfinger_width: 0.02\n"
    "finger_thickness: 0.01\ntip_offset: 0.012\npalm_width: 0.13\npalm_height: 0.06\n"
    "palm_depth: 0.09\n";

class LoadGripper : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(directory_); }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    /// A directory of this test's own.
    const std::filesystem::path& directory() const { return directory_; }
    std::filesystem::path write(const std::string& text, const std::string& name = "a.yaml") {
        const auto file = directory() / name;
        std::ofstream(file) << text;
        return file;
    }
    std::string error_of(const std::string& text) {
        const auto loaded = load_gripper(write(text));
        EXPECT_FALSE(loaded.ok()) << text;
        if (loaded.ok()) return "";
        EXPECT_EQ(loaded.error().code, PlanErrorCode::kInvalidInput);
        return loaded.error().detail;
    }

private:
    const std::filesystem::path directory_ =
        std::filesystem::path(testing::TempDir()) / ("gripper_" + std::to_string(getpid()));
};

TEST_F(LoadGripper, EveryKeyGoesToItsField) {
    const auto loaded = load_gripper(write(std::string(kComplete) +
                                           "min_width: 0.003\npalm_z: -0.02\nclosing_yaw: 0.5\n"
                                           "pad_travel:\n  - {opening: 0.0, pad_z: 0.14}\n"
                                           "  - {opening: 0.1, pad_z: 0.13}\n"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    const Gripper& gripper = loaded.value();
    EXPECT_EQ(gripper.name, "test_hand");
    EXPECT_EQ(gripper.min_width_m, 0.003);
    EXPECT_EQ(gripper.max_width_m, 0.1);
    EXPECT_EQ(gripper.finger_length_m, 0.05);
    EXPECT_EQ(gripper.finger_width_m, 0.02);
    EXPECT_EQ(gripper.finger_thickness_m, 0.01);
    EXPECT_EQ(gripper.tip_offset_m, 0.012);
    EXPECT_EQ(gripper.palm_width_m, 0.13);
    EXPECT_EQ(gripper.palm_height_m, 0.06);
    EXPECT_EQ(gripper.palm_depth_m, 0.09);
    EXPECT_EQ(gripper.palm_z_m, -0.02);
    EXPECT_EQ(gripper.closing_yaw_rad, 0.5);
    ASSERT_EQ(gripper.pad_travel.size(), 2u);
    EXPECT_EQ(gripper.pad_travel[1].opening_m, 0.1);
    EXPECT_EQ(gripper.pad_travel[1].pad_z_m, 0.13);
}

TEST_F(LoadGripper, AMissingDimensionIsNamedAndNeverGuessed) {
    EXPECT_THAT(error_of("name: hand\nmax_width: 0.1\n"), HasSubstr("finger_length is missing"));
    EXPECT_THAT(error_of(""), HasSubstr("name is missing"));
}

TEST_F(LoadGripper, WrongKeysTypesAndRangesAreNamedWithTheFile) {
    const std::string good = kComplete;
    EXPECT_THAT(error_of(good + "colour: 3\n"),
                AllOf(HasSubstr("a.yaml:10: unknown key colour"),
                      HasSubstr("pad_travel, convex_parts, moveit)")));
    EXPECT_THAT(error_of(good + "palm_z: low\n"), HasSubstr("palm_z = low must be a number"));
    EXPECT_THAT(error_of(good + "min_width: 0.2\n"),
                AllOf(HasSubstr("a.yaml"), HasSubstr("min_width = 0.2 is outside [0, 0.1]")));
    EXPECT_THAT(error_of(good + "pad_travel: 5\n"), HasSubstr("pad_travel = 5 must be a list"));
    EXPECT_THAT(error_of(good + "pad_travel: [{opening: 0.1}]\n"), HasSubstr("pad_travel row"));
    EXPECT_THAT(error_of(good + "pad_travel: [{opening: 0.1, pad_z: 0.1, z: 1}]\n"),
                HasSubstr("unknown key z"));
    EXPECT_THAT(error_of(good + "pad_travel: [{opening: 0.1, pad_z: 0.1}, "
                                "{opening: 0.1, pad_z: 0.2}]\n"),
                HasSubstr("does not rise"));
    EXPECT_THAT(error_of(good + "convex_parts: [{member: palm, hull: []}]\n"),
                HasSubstr("convex_parts[0] = (a group of keys) must be {member: "));
    EXPECT_THAT(error_of("name: two words\n" + good.substr(good.find('\n') + 1)),
                HasSubstr("name = two words must be"));
}

TEST_F(LoadGripper, ADirectoryIsReadInTheOrderOfTheNames) {
    const std::string tail = std::string(kComplete).substr(std::string(kComplete).find('\n'));
    write("name: zeta" + tail, "1.yaml");
    write("name: alpha" + tail, "2.yaml");
    write("not a profile", "README.md");
    const auto loaded = load_grippers(directory());
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    ASSERT_EQ(loaded.value().size(), 2u);
    EXPECT_EQ(loaded.value()[0].name, "alpha");
    EXPECT_EQ(loaded.value()[1].name, "zeta");
}

TEST_F(LoadGripper, TwoProfilesOfOneNameAreRefused) {
    write(kComplete, "1.yaml");
    write(kComplete, "2.yaml");
    const auto loaded = load_grippers(directory());
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(loaded.error().detail, AllOf(HasSubstr("2.yaml"), HasSubstr("test_hand")));
}

TEST_F(LoadGripper, ADirectoryWithoutProfilesIsAnError) {
    for (const auto& place : {directory(), std::filesystem::path("/nowhere")}) {
        const auto loaded = load_grippers(place);
        ASSERT_FALSE(loaded.ok());
        EXPECT_EQ(loaded.error().code, PlanErrorCode::kUnreadableFile);
        EXPECT_THAT(loaded.error().detail, HasSubstr(place.string()));
    }
}

TEST_F(LoadGripper, IsFoundByNameOrByFile) {
    const auto by_name = find_gripper("franka_hand", kGrippers);
    ASSERT_TRUE(by_name.ok()) << by_name.error().detail;
    EXPECT_EQ(by_name.value().name, "franka_hand");
    const auto by_file = find_gripper((kGrippers / "franka_hand.yaml").string(), "/nowhere");
    EXPECT_TRUE(by_file.ok());
    const auto unknown = find_gripper("robotiq", kGrippers);
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().code, PlanErrorCode::kUnknownGripper);
    EXPECT_THAT(unknown.error().detail,
                AllOf(HasSubstr("robotiq is unknown"), HasSubstr("parallel_85")));
}

// ---- the shipped profiles

TEST_F(LoadGripper, TheFourShippedProfilesAreValid) {
    const auto loaded = load_grippers(kGrippers);
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    std::vector<std::string> names;
    for (const Gripper& gripper : loaded.value()) names.push_back(gripper.name);
    EXPECT_THAT(names,
                ElementsAre("franka_hand", "parallel_85", "robotiq_2f_140", "robotiq_2f_85"));
}

// The linkage is a parallelogram: its pads move on a circle whose radius is the length of a link.
// Three measured points fix that circle; the others must lie on it, and the fingertip heights at
// the measured openings are those of the gripper's data sheet in the profile's comment.
struct Linkage {
    const char* name;
    double radius_m;
    std::array<std::array<double, 2>, 3> opening_and_tip_z_m;
};

class ShippedLinkage : public testing::TestWithParam<Linkage> {};

TEST_P(ShippedLinkage, PadsTravelOnTheMeasuredArc) {
    const Linkage& linkage = GetParam();
    const auto loaded = find_gripper(linkage.name, kGrippers);
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    const Gripper& gripper = loaded.value();
    for (const auto& [opening, tip_z] : linkage.opening_and_tip_z_m) {
        EXPECT_NEAR(pad_z_m(gripper, opening) + gripper.tip_offset_m, tip_z, 1e-9);
    }
    // The circle through the first and the last row with that radius, bulging forward.
    const auto& first = gripper.pad_travel.front();
    const auto& last = gripper.pad_travel.back();
    const Eigen::Vector2d a(0.5 * first.opening_m, first.pad_z_m);
    const Eigen::Vector2d b(0.5 * last.opening_m, last.pad_z_m);
    const Eigen::Vector2d along = (b - a).normalized();
    const double half = 0.5 * (b - a).norm();
    const Eigen::Vector2d center =
        0.5 * (a + b) + std::sqrt(linkage.radius_m * linkage.radius_m - half * half) *
                            Eigen::Vector2d(along.y(), -along.x());
    for (const PadTravel& row : gripper.pad_travel) {
        const Eigen::Vector2d pad(0.5 * row.opening_m, row.pad_z_m);
        EXPECT_NEAR((pad - center).norm(), linkage.radius_m, 3e-4) << row.opening_m;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Robotiq, ShippedLinkage,
    testing::Values(
        Linkage{"robotiq_2f_85", 0.0572, {{{0.0850, 0.1493}, {0.0453, 0.1604}, {0.0010, 0.1629}}}},
        Linkage{
            "robotiq_2f_140", 0.1000, {{{0.1285, 0.2120}, {0.0684, 0.2295}, {0.0008, 0.2357}}}}),
    [](const auto& linkage) { return std::string(linkage.param.name); });

// A palm that starts where the closed finger ends would leave a slot that no part covers.
TEST_F(LoadGripper, PalmAndFingersOfEveryShippedProfileMeetAtEveryOpening) {
    const auto loaded = load_grippers(kGrippers);
    ASSERT_TRUE(loaded.ok());
    for (const Gripper& gripper : loaded.value()) {
        for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double opening =
                gripper.min_width_m + share * (gripper.max_width_m - gripper.min_width_m);
            const auto parts = gripper_parts(gripper, opening, opening);
            EXPECT_LE(parts[1].box_G.min().z(), parts[0].box_G.max().z() + 1e-9)
                << gripper.name << " open by " << opening;
            EXPECT_LT(parts[0].box_G.max().z(), 0.0) << gripper.name << ": palm before the pads";
        }
    }
}

TEST_F(LoadGripper, HandsThatCloseAlongHyAreTurnedByAQuarter) {
    for (const char* name : {"franka_hand", "robotiq_2f_140"}) {
        const auto loaded = find_gripper(name, kGrippers);
        ASSERT_TRUE(loaded.ok());
        const Eigen::Isometry3d X_HG = grasp_in_hand(loaded.value(), 0.04);
        EXPECT_TRUE(X_HG.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12)) << name;
        EXPECT_TRUE(X_HG.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12)) << name;
    }
}

// ---- where profiles are looked for

TEST_F(LoadGripper, ProfilesComeFromTheEnvironmentThenTheInstallationThenTheSources) {
    const auto root = directory();
    const auto given = root / "given";
    const auto installed = root / "usr/share/graspd/profiles";
    const auto sources = root / "sources";
    for (const auto& path : {given, installed, sources, root / "usr/bin"}) {
        std::filesystem::create_directories(path);
    }
    const auto program = root / "usr/bin/graspd";
    EXPECT_EQ(find_profiles({given.string(), program, sources}).value(), given);
    EXPECT_EQ(find_profiles({"", program, sources}).value(), installed);
    EXPECT_EQ(find_profiles({"", root / "build/src/graspd", sources}).value(), sources);
}

TEST_F(LoadGripper, AWrongEnvironmentIsAnErrorNotAFallback) {
    const auto found = find_profiles({"/nowhere", "/usr/bin/graspd", kGrippers});
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().detail, HasSubstr("GRASPD_PROFILES = /nowhere"));
    const auto none = find_profiles({"", directory() / "bin/graspd", directory() / "none"});
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, PlanErrorCode::kUnreadableFile);
}

TEST_F(LoadGripper, ThisProcessFindsTheSourceTreesProfiles) {
    const auto places = profile_places();
    EXPECT_FALSE(places.executable.empty());
    EXPECT_EQ(places.source_tree, GRASPD_SOURCE_DIR "/profiles");
}

}  // namespace
}  // namespace graspd
