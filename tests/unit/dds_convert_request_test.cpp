#include "convert_request.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/plan_samples.hpp"

namespace graspd::dds {
namespace {

using test::expect_same;
using test::full_request;
using test::small_request;
using testing::AllOf;
using testing::HasSubstr;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

wire::GraspRequest_ on_wire(const PlanRequest& request) {
    auto written = write_request(request, "client");
    EXPECT_TRUE(written.ok());
    return written.ok() ? std::move(written).value() : wire::GraspRequest_{};
}

TEST(ConvertRequest, EveryFieldComesBack) {
    const auto back = read_request(on_wire(full_request()), {});
    ASSERT_TRUE(back.ok()) << back.error().detail;
    expect_same(full_request(), back.value());
}

TEST(ConvertRequest, DefaultsComeBack) {
    const auto back = read_request(on_wire(small_request()), {});
    ASSERT_TRUE(back.ok()) << back.error().detail;
    expect_same(small_request(), back.value());
}

// The boxes around the parts and the pads' size are the same at both ends.
TEST(ConvertRequest, ConvexPartsComeBack) {
    PlanRequest request = small_request();
    Gripper gripper;
    gripper.name = "hulls";
    gripper.convex_parts = {
        {"", GripperMember::kPalm, {{0, 0, 0}, {0.05, 0, 0}, {0, 0.03, 0}, {0, 0, 0.07}}},
        {"",
         GripperMember::kFingerRight,
         {{0.0425, -0.014, 0.06}, {0.055, 0, 0.07}, {0.0425, 0.012, 0.06}, {0.0425, 0, 0.13}}},
        {"",
         GripperMember::kFingerLeft,
         {{-0.0425, -0.014, 0.06}, {-0.055, 0, 0.07}, {-0.0425, 0.012, 0.06}, {-0.0425, 0, 0.13}}}};
    fit_boxes(gripper);
    request.grippers = {gripper};
    const auto back = read_request(on_wire(request), {});
    ASSERT_TRUE(back.ok()) << back.error().detail;
    const Gripper& out = back.value().grippers.at(0);
    ASSERT_EQ(out.convex_parts.size(), 3u);
    EXPECT_EQ(out.convex_parts[0].points, gripper.convex_parts[0].points);
    EXPECT_EQ(out.convex_parts[1].member, GripperMember::kFingerLeft);  // palm, left, right
    EXPECT_EQ(out.convex_parts[1].points, gripper.convex_parts[2].points);
    EXPECT_EQ(out.convex_parts[2].points, gripper.convex_parts[1].points);
    EXPECT_NEAR(out.palm_width_m, 0.10, 1e-15);
    EXPECT_NEAR(out.palm_depth_m, 0.07, 1e-15);
    EXPECT_NEAR(out.finger_width_m, 0.028, 1e-15);
    EXPECT_NEAR(out.finger_thickness_m, 0.0125, 1e-15);
    EXPECT_NEAR(out.tip_offset_m, gripper.tip_offset_m, 1e-15);
    EXPECT_NEAR(out.finger_length_m, gripper.finger_length_m, 1e-15);
    EXPECT_EQ(pad_half_size_m(out), Eigen::Vector2d(0.01, 0.01));
    EXPECT_EQ(pad_z_m(out, 0.02), pad_z_m(gripper, 0.02));
}

TEST(ConvertRequest, CloudComesBackWithItsNaNAndSensor) {
    PlanRequest request = small_request();
    request.object_O = PointCloud{{{1, 2, 3}, {0.1, 0.2, 0.3}}, Eigen::Vector3d(0, 0, 1)};
    const auto back = read_request(on_wire(request), {});
    ASSERT_TRUE(back.ok()) << back.error().detail;
    expect_same(request, back.value());

    std::get<PointCloud>(request.object_O).points[1].y() = kNaN;
    const auto holed = read_request(on_wire(request), {});
    ASSERT_TRUE(holed.ok()) << holed.error().detail;
    const auto& points = std::get<PointCloud>(holed.value().object_O).points;
    EXPECT_TRUE(std::isnan(points[1].y()));
    EXPECT_EQ(points[1].x(), 0.1);
}

// Rotations that are no multiple of a right angle pass through a quaternion: 1e-15 of error at
// most.
TEST(ConvertRequest, AnyPoseComesBackToTheLastDigits) {
    PlanRequest request = small_request();
    for (int i = 1; i < 50; ++i) {
        request.X_FO.linear() = (Eigen::AngleAxisd(0.37 * i, Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(-1.1 * i, Eigen::Vector3d::UnitZ()))
                                    .toRotationMatrix();
        const auto back = read_request(on_wire(request), {});
        ASSERT_TRUE(back.ok());
        const Eigen::Matrix3d error = back.value().X_FO.linear() - request.X_FO.linear();
        EXPECT_LE(error.cwiseAbs().maxCoeff(), 1e-15);
    }
}

// DESIGN 5, Absent: no PlanOptions means PlanOptions{}; 0 means the default where it says so.
TEST(ConvertRequest, AbsentOptionsAreTheDefaults) {
    wire::GraspRequest_ request = on_wire(full_request());
    request.options().clear();
    PlanRequest expected = full_request();
    expected.options = {};
    const auto none = read_request(request, {});
    ASSERT_TRUE(none.ok());
    expect_same(expected, none.value());

    wire::PlanOptions_ zeros;
    zeros.friction(0.6);
    request.options().push_back(zeros);
    const auto zero = read_request(request, {});
    ASSERT_TRUE(zero.ok());
    expect_same(expected, zero.value());
}

TEST(ConvertRequest, NamedGripperIsLookedUp) {
    wire::GraspRequest_ request = on_wire(small_request());
    request.grippers().clear();
    request.gripper("two");
    std::vector<Gripper> known(2);
    known[0].name = "one";
    known[1].name = "two";
    known[1].max_width_m = 0.125;
    const auto found = read_request(request, known);
    ASSERT_TRUE(found.ok());
    ASSERT_EQ(found.value().grippers.size(), 1u);
    EXPECT_EQ(found.value().grippers[0].max_width_m, 0.125);

    request.gripper("three");
    const auto unknown = read_request(request, known);
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().code, PlanErrorCode::kUnknownGripper);
    EXPECT_THAT(unknown.error().detail, AllOf(HasSubstr("\"three\""), HasSubstr("one, two")));
}

TEST(ConvertRequest, ObjectKeyLeavesTheObjectEmpty) {
    wire::GraspRequest_ request = on_wire(small_request());
    request.mesh({});
    request.object_key("0123456789abcdef");
    const auto read = read_request(request, {});
    ASSERT_TRUE(read.ok()) << read.error().detail;
    EXPECT_TRUE(std::get<TriangleMesh>(read.value().object_O).vertices.empty());
}

TEST(ConvertRequest, QuaternionAndDirectionsAreMadeUnit) {
    wire::GraspRequest_ request = on_wire(full_request());
    request.object_pose()[0].orientation().x(0);
    request.object_pose()[0].orientation().y(0);
    request.object_pose()[0].orientation().z(0.7072);  // three decimals and a bit of a right turn
    request.object_pose()[0].orientation().w(0.7072);
    request.support_plane()[0].normal(write_vector({0, 0, 1.0009}));
    const auto read = read_request(request, {});
    ASSERT_TRUE(read.ok()) << read.error().detail;
    const Eigen::Matrix3d turn = read.value().X_FO.linear();
    EXPECT_LE((turn.col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
    EXPECT_EQ(read.value().support_plane->normal_F, Eigen::Vector3d::UnitZ());
}

TEST(ConvertRequest, WriteRefusesWhatTheWireCannotCarry) {
    PlanRequest request = small_request();
    request.request_id = std::string(65, 'x');
    EXPECT_EQ(write_request(request, "c").error().code, PlanErrorCode::kInvalidInput);
    request.request_id = "";
    EXPECT_EQ(write_request(request, "c").error().code, PlanErrorCode::kInvalidInput);
    request.request_id = "fine";
    EXPECT_FALSE(write_request(request, std::string(65, 'c')).ok());
    EXPECT_TRUE(write_request(request, "").ok());
}

}  // namespace
}  // namespace graspd::dds
