// Two hands written out as URDF whose positions are worked out by hand. Lengths in the comments in
// mm.

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>

#include "graspd/config/load_gripper.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

std::string box(const std::string& size, const std::string& xyz) {
    return "<collision><origin xyz=\"" + xyz + "\"/><geometry><box size=\"" + size +
           "\"/></geometry></collision>";
}
std::string link(const std::string& name, const std::string& inside) {
    return "<link name=\"" + name + "\">" + inside + "</link>\n";
}
std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& rest) {
    return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/>" + rest + "</joint>\n";
}
constexpr const char* kLimit = "<limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>";

/// Palm 80 x 60 x 50, its rear at z = 0. Fingers 12 x 20 x 40 hang at x = -+46, z = 50, their pads
/// at x = -+40, z = 80; both slide inward by the driver, 0 to 40, less 0.6 for the right one.
std::string parallel_jaw() {
    return "<robot name=\"jaw\">" + link("hand", box("0.08 0.06 0.05", "0 0 0.025")) +
           link("left", box("0.012 0.02 0.04", "0 0 0.02")) +
           link("right", box("0.012 0.02 0.04", "0 0 0.02")) +
           joint("drive", "prismatic", "hand", "left",
                 std::string("<origin xyz=\"-0.046 0 0.05\"/><axis xyz=\"1 0 0\"/>") + kLimit) +
           joint("follow", "prismatic", "hand", "right",
                 std::string("<origin xyz=\"0.046 0 0.05\"/><axis xyz=\"-1 0 0\"/>") + kLimit +
                     "<mimic joint=\"drive\" multiplier=\"1\" offset=\"-0.0006\"/>") +
           "</robot>";
}

/// Cranks of 60 mm turn about -+y from (-+20, 0, 50), straight out and up by 30 degrees when the
/// driver is 0, and up by the driver; the tips, 10 x 20 x 30 with their pads on the inner side at z
/// = 15 from their joint, turn back. A fixed joint carries each tip's box.
std::string four_bar() {
    const auto side = [](const std::string& s, const std::string& sign, const std::string& opposite,
                         const std::string& drive) {
        const std::string axis = "<axis xyz=\"0 " + sign + "1 0\"/>";
        const std::string mimic = drive.empty() ? "" : "<mimic joint=\"drive_left\"/>";
        const std::string limit =
            "<limit lower=\"0\" upper=\"1.0471975511965976\" effort=\"1\" velocity=\"1\"/>";
        // The crank's frame leans out by 60 degrees from z, so that z runs along it.
        const std::string lean = "<origin xyz=\"" + opposite + "0.02 0 0.05\" rpy=\"0 " + opposite +
                                 "1.0471975511965976 0\"/>";
        const std::string upright =
            "<origin xyz=\"0 0 0.06\" rpy=\"0 " + sign + "1.0471975511965976 0\"/>";
        return link("crank_" + s, box("0.01 0.01 0.06", "0 0 0.03")) + link("joint_" + s, "") +
               link("tip_" + s, box("0.01 0.02 0.03", opposite + "0.005 0 0.015")) +
               joint("drive_" + s, "revolute", "hand", "crank_" + s, lean + axis + limit + mimic) +
               joint("back_" + s, "revolute", "crank_" + s, "joint_" + s,
                     upright + axis + limit + "<mimic joint=\"drive_" + s +
                         "\" multiplier=\"-1\"/>") +
               joint("fix_" + s, "fixed", "joint_" + s, "tip_" + s, "");
    };
    return "<robot name=\"bar\">" + link("hand", box("0.08 0.06 0.05", "0 0 0.025")) +
           side("left", "", "-", "") + side("right", "-", "", "drive_left") + "</robot>";
}

const std::map<std::string, std::string> kJawProfile = {
    {"name", "jaw"},
    {"urdf", "hand.urdf"},
    {"mount_link", "hand"},
    {"driver_joint", "drive"},
    {"palm_links", "[hand]"},
    {"left_links", "[left]"},
    {"right_links", "[right]"},
    {"left_pad", "{link: left, point: [0.006, 0, 0.03]}"},
    {"right_pad", "{link: right, point: [-0.006, 0, 0.03]}"},
    {"pad_width", "0.016"},
    {"pad_height", "0.02"}};

std::map<std::string, std::string> bar_profile() {
    auto keys = kJawProfile;
    keys["name"] = "bar";
    keys["driver_joint"] = "drive_left";
    keys["left_links"] = "[crank_left, tip_left]";
    keys["right_links"] = "[crank_right, tip_right]";
    keys["left_pad"] = "{link: tip_left, point: [0, 0, 0.015]}";
    keys["right_pad"] = "{link: tip_right, point: [0, 0, 0.015]}";
    return keys;
}

class UrdfGripper : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(directory_); }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    Result<Gripper> load(const std::string& urdf, const std::map<std::string, std::string>& keys) {
        std::ofstream(directory_ / "hand.urdf") << urdf;
        std::ofstream profile(directory_ / "hand.yaml");
        for (const auto& [key, value] : keys) profile << key << ": " << value << '\n';
        profile.close();
        return find_gripper((directory_ / "hand.urdf").string(), directory_);
    }
    std::string error_of(const std::string& urdf, const std::map<std::string, std::string>& keys) {
        const auto loaded = load(urdf, keys);
        EXPECT_FALSE(loaded.ok());
        return loaded.ok() ? "" : loaded.error().detail;
    }
    const std::filesystem::path directory_ =
        std::filesystem::path(testing::TempDir()) / ("urdf_" + std::to_string(getpid()));
};

Eigen::AlignedBox3d bounds(const std::vector<Vector3d>& points) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : points) box.extend(point);
    return box;
}
void expect_bounds(const PlacedPart& part, const Vector3d& low, const Vector3d& high) {
    const Eigen::AlignedBox3d box = bounds(part.points_G);
    EXPECT_LT((box.min() - low).norm(), 1e-9) << box.min().transpose();
    EXPECT_LT((box.max() - high).norm(), 1e-9) << box.max().transpose();
}

// Open: 80 + 0.6 between the pads, as the right one hangs back. Closed: 0.6. The midpoint is off
// the axis by 0.3 all the time.
TEST_F(UrdfGripper, ParallelJaw) {
    const auto loaded = load(parallel_jaw(), kJawProfile);
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    const Gripper& gripper = loaded.value();
    EXPECT_NEAR(gripper.max_width_m, 0.0806, 1e-12);
    EXPECT_NEAR(gripper.min_width_m, 0.0006, 1e-12);
    EXPECT_NEAR(gripper.closing_yaw_rad, 0.0, 1e-12);
    EXPECT_NEAR(pad_z_m(gripper, 0.05), 0.08, 1e-12);
    EXPECT_NEAR(gripper.palm_depth_m, 0.05, 1e-12);
    EXPECT_NEAR(gripper.palm_width_m, 0.08, 1e-12);
    EXPECT_NEAR(gripper.finger_length_m, 0.04, 1e-12);
    EXPECT_NEAR(gripper.finger_width_m, 0.02, 1e-12);
    EXPECT_NEAR(gripper.finger_thickness_m, 0.0123, 1e-12);  // 12, and 0.3 off the middle
    EXPECT_NEAR(gripper.tip_offset_m, 0.01, 1e-12);
    EXPECT_NEAR(pad_half_size_m(gripper).x(), 0.008, 1e-12);
    // Open by 40.6: both drives at 20. Left from -46 - 6 + 20 = -32 to -20; right from 20.6
    // to 32.6. G's origin is at z = 80.
    const auto parts = placed_parts(gripper, 0.03, 0.0406);
    ASSERT_EQ(parts.size(), 3U);
    expect_bounds(parts[0], {-0.04, -0.03, -0.08}, {0.04, 0.03, -0.03});
    expect_bounds(parts[1], {-0.032, -0.01, -0.03}, {-0.02, 0.01, 0.01});
    expect_bounds(parts[2], {0.0206, -0.01, -0.03}, {0.0326, 0.01, 0.01});
    EXPECT_EQ(parts[2].member, GripperMember::kFingerRight);
}

// At the driver's angle a a crank points 30 degrees + a up from level: its end is 20 + 60 cos(30 +
// a) beside the axis and 50 + 60 sin(30 + a) up; the pad another 15 up. Open: 143.92 wide, z = 95;
// at a = 30: 100 wide, z = 116.96; closed at a = 60: 40 wide, z = 125.
TEST_F(UrdfGripper, FourBarLinkage) {
    const auto loaded = load(four_bar(), bar_profile());
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    const Gripper& gripper = loaded.value();
    const double root = std::sqrt(3.0);
    EXPECT_NEAR(gripper.max_width_m, 0.04 + 0.06 * root, 1e-9);
    EXPECT_NEAR(gripper.min_width_m, 0.04, 1e-9);
    EXPECT_NEAR(pad_z_m(gripper, gripper.max_width_m), 0.095, 1e-9);
    EXPECT_NEAR(pad_z_m(gripper, 0.1), 0.065 + 0.03 * root, 5e-6);  // a table of 64 rows
    EXPECT_NEAR(pad_z_m(gripper, 0.04), 0.125, 1e-9);
    EXPECT_NEAR(driver_position(*gripper.linkage, 0.1), kPi / 6, 1e-9);
    // Open by 100, with the TCP where pads 40 apart are: 125 up. The tips stay upright: x from 50
    // to 60, z from 50 + 51.96 to 30 more. The crank runs from (20, 50) at 60 degrees, 10 thick.
    const auto parts = placed_parts(gripper, 0.04, 0.1);
    ASSERT_EQ(parts.size(), 5U);
    const double tip_z = 0.05 + 0.03 * root - 0.125;
    const auto& tip_right = parts[4];
    const auto& tip_left = parts[2];
    expect_bounds(tip_right, {0.05, -0.01, tip_z}, {0.06, 0.01, tip_z + 0.03});
    expect_bounds(tip_left, {-0.06, -0.01, tip_z}, {-0.05, 0.01, tip_z + 0.03});
    const double aside = 0.005 * std::sin(kPi / 3), up = 0.005 * std::cos(kPi / 3);
    expect_bounds(parts[3], {0.02 - aside, -0.005, 0.05 - up - 0.125},
                  {0.05 + aside, 0.005, tip_z + up});
    EXPECT_GT(sagitta_bound(*gripper.linkage, gripper.convex_parts[4].joint, 0.03), 0.06 / 8.0);
}

// The smallest ball about all corners of a hull that holds the shape.
TEST_F(UrdfGripper, CylindersAndSpheresAreHeld) {
    auto urdf = parallel_jaw();
    const std::string palm = box("0.08 0.06 0.05", "0 0 0.025");
    const auto with_palm = [&](const std::string& geometry) {
        std::string text = urdf;
        text.replace(text.find(palm), palm.size(),
                     "<collision><origin xyz=\"0 0 0.03\"/><geometry>" + geometry +
                         "</geometry></collision>");
        const auto loaded = load(text, kJawProfile);
        EXPECT_TRUE(loaded.ok()) << loaded.error().detail;
        return loaded.ok() ? loaded.value().convex_parts[0].points : std::vector<Vector3d>();
    };
    const auto reach = [](const std::vector<Vector3d>& points, const Vector3d& direction) {
        double most = -1.0;
        for (const Vector3d& p : points)
            most = std::max(most, direction.dot(p - Vector3d(0, 0, 0.03)));
        return most;
    };
    const auto ball = with_palm("<sphere radius=\"0.02\"/>");
    const auto rod = with_palm("<cylinder radius=\"0.02\" length=\"0.05\"/>");
    for (int i = 0; i < 500; ++i) {
        const double t = 0.7 * i, h = std::cos(0.37 * i);
        const Vector3d level(std::cos(t), std::sin(t), 0.0);
        const Vector3d any = std::sqrt(1.0 - h * h) * level + h * Vector3d::UnitZ();
        EXPECT_GE(reach(ball, any), 0.02 - 1e-12);
        EXPECT_LE(reach(ball, any), 0.0204);
        EXPECT_GE(reach(rod, level), 0.02 - 1e-12);
        EXPECT_LE(reach(rod, level), 0.0202);
    }
    EXPECT_NEAR(reach(rod, Vector3d::UnitZ()), 0.025, 1e-12);
    EXPECT_NEAR(reach(rod, -Vector3d::UnitZ()), 0.025, 1e-12);
}

// A tetrahedron in millimetres, found in a package's folder above the URDF and beside it.
TEST_F(UrdfGripper, MeshesAreFound) {
    const std::string stl =
        "solid t\n"
        "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 30 0\nvertex 40 0 "
        "0\nendloop\nendfacet\n"
        "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 40 0 0\nvertex 0 0 "
        "50\nendloop\nendfacet\n"
        "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 50\nvertex 0 30 "
        "0\nendloop\nendfacet\n"
        "facet normal 1 1 1\nouter loop\nvertex 40 0 0\nvertex 0 30 0\nvertex 0 0 "
        "50\nendloop\nendfacet\n"
        "endsolid t\n";
    std::ofstream(directory_ / "palm.stl") << stl;
    const std::string palm = box("0.08 0.06 0.05", "0 0 0.025");
    const std::string package = directory_.filename().string();
    for (const std::string& name :
         {std::string("palm.stl"), "package://" + package + "/palm.stl"}) {
        std::string text = parallel_jaw();
        text.replace(text.find(palm), palm.size(),
                     "<collision><geometry><mesh filename=\"" + name +
                         "\" scale=\"0.001 0.001 0.001\"/></geometry></collision>");
        const auto loaded = load(text, kJawProfile);
        ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
        EXPECT_EQ(loaded.value().convex_parts[0].points.size(), 4U);
        EXPECT_NEAR(loaded.value().palm_width_m, 0.08, 1e-9);  // 40 on one side
        EXPECT_NEAR(loaded.value().palm_depth_m, 0.05, 1e-9);
    }
    std::string text = parallel_jaw();
    text.replace(text.find(palm), palm.size(),
                 "<collision><geometry><mesh filename=\"other.stl\"/></geometry></collision>");
    EXPECT_THAT(error_of(text, kJawProfile), AllOf(HasSubstr("other.stl"), HasSubstr("not found")));
}

TEST_F(UrdfGripper, ErrorsNameFieldAndValue) {
    const auto with = [](const std::string& key, const std::string& value) {
        auto keys = kJawProfile;
        keys[key] = value;
        return keys;
    };
    const auto without = [](const std::string& key) {
        auto keys = kJawProfile;
        keys.erase(key);
        return keys;
    };
    const std::string jaw = parallel_jaw();
    EXPECT_THAT(error_of(jaw, with("mount_link", "arm")), HasSubstr("mount_link = arm"));
    EXPECT_THAT(error_of(jaw, with("driver_joint", "motor")), HasSubstr("driver_joint = motor"));
    EXPECT_THAT(error_of(jaw, with("driver_joint", "follow")),
                AllOf(HasSubstr("joint drive"), HasSubstr("driver_joint = follow")));
    EXPECT_THAT(error_of(jaw, with("left_links", "[lever]")), HasSubstr("link lever"));
    EXPECT_THAT(error_of(jaw, with("left_links", "left")),
                AllOf(HasSubstr("left_links = left"), HasSubstr("list")));
    EXPECT_THAT(error_of(jaw, without("right_links")), HasSubstr("right_links is missing"));
    EXPECT_THAT(error_of(jaw, without("pad_width")), HasSubstr("pad_width is missing"));
    EXPECT_THAT(error_of(jaw, with("left_pad", "{link: left, point: [0, 1]}")),
                AllOf(HasSubstr("left_pad.point"), HasSubstr("three numbers")));
    EXPECT_THAT(error_of(jaw, with("left_pad", "{link: left, place: 1, point: [0, 0, 0]}")),
                HasSubstr("left_pad.place"));
    EXPECT_THAT(error_of(jaw, with("left_pad", "left")), HasSubstr("left_pad = left"));
    EXPECT_THAT(error_of(jaw, with("left_pad", "{link: left, point: [0.006, 0.01, 0.03]}")),
                HasSubstr("opposite"));
    EXPECT_THAT(error_of(jaw, with("open", "wide")), HasSubstr("open = wide"));
    EXPECT_THAT(error_of(jaw, with("closed", "0.045")), HasSubstr("below 0"));
    EXPECT_THAT(error_of(jaw, with("pad_size", "1")), HasSubstr("pad_size"));
    EXPECT_THAT(error_of("<robot", kJawProfile), HasSubstr("is no URDF"));
    std::string bare = jaw;
    const std::string finger = box("0.012 0.02 0.04", "0 0 0.02");
    bare.replace(bare.find(finger), finger.size(), "");
    EXPECT_THAT(error_of(bare, kJawProfile), HasSubstr("link left has no collision geometry"));
    std::filesystem::remove(directory_ / "hand.yaml");
    const auto alone = find_gripper((directory_ / "hand.urdf").string(), directory_);
    ASSERT_FALSE(alone.ok());
    EXPECT_THAT(alone.error().detail, AllOf(HasSubstr("hand.urdf"), HasSubstr("hand.yaml")));
}

}  // namespace
}  // namespace graspd
