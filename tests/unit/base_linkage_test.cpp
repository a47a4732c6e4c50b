#include "graspd/base/linkage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// A crank of 50 mm that turns about y from H's origin, and a link at its end that turns back by as
/// much, so that it stays upright; the right pad is 10 mm above its joint. The left pad is fixed.
Linkage crank() {
    Linkage linkage;
    LinkageJoint turn{"crank", -1, Eigen::Isometry3d::Identity(), Vector3d::UnitY(), false,
                      1.0,     0.0};
    LinkageJoint back{
        "tip", 0,  Eigen::Isometry3d(Eigen::Translation3d(0.05, 0, 0)), Vector3d::UnitY(), false,
        -1.0,  0.0};
    linkage.joints = {turn, back};
    linkage.pads = {PadMount{-1, {-0.01, 0, 0}}, PadMount{1, {0, 0, 0.01}}};
    linkage.open_q = 0.0;
    linkage.closed_q = -kPi / 3;  // about y this lifts x towards z
    return linkage;
}

// At the angle a the crank's end is at (50 cos a, 0, 50 sin a) mm.
TEST(Linkage, MimicKeepsTheTipUpright) {
    const Linkage linkage = crank();
    EXPECT_FALSE(validate(linkage));
    for (const double a : {0.0, 0.3, kPi / 3}) {
        const auto poses = link_poses_H(linkage, -a);
        EXPECT_LT(
            (poses[1].translation() - Vector3d(0.05 * std::cos(a), 0, 0.05 * std::sin(a))).norm(),
            1e-15);
        EXPECT_LT((poses[1].linear() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
        EXPECT_NEAR(pad_point_H(linkage, 1, -a).z(), 0.01 + 0.05 * std::sin(a), 1e-15);
        EXPECT_NEAR(pad_gap_m(linkage, -a), 0.01 + 0.05 * std::cos(a), 1e-15);
    }
}

// The gap 10 + 50 cos a is 60 at 0, 53.3 at 30 and 35 at 60 degrees.
TEST(Linkage, TheDriverIsFoundFromTheOpening) {
    const Linkage linkage = crank();
    EXPECT_NEAR(driver_position(linkage, 0.01 + 0.05 * std::cos(kPi / 6)), -kPi / 6, 1e-12);
    EXPECT_EQ(driver_position(linkage, 0.2), 0.0);
    EXPECT_EQ(driver_position(linkage, 0.0), linkage.closed_q);
}

TEST(Linkage, SlidesByMultiplierAndOffset) {
    Linkage linkage;
    const Eigen::Isometry3d aside(Eigen::Translation3d(0, 0, 0.08));
    linkage.joints = {{"left", -1, aside, Vector3d::UnitX(), true, -0.5, -0.001},
                      {"right", -1, aside, Vector3d::UnitX(), true, 0.5, 0.002}};
    linkage.pads = {PadMount{0, {0, 0, 0.03}}, PadMount{1, {0, 0, 0.03}}};
    linkage.open_q = 0.08;
    EXPECT_NEAR(pad_gap_m(linkage, 0.04), 0.043, 1e-15);  // 20 + 2 to the right, 20 + 1 to the left
    EXPECT_NEAR(pad_point_H(linkage, 0, 0.04).z(), 0.11, 1e-15);
    EXPECT_EQ(sagitta_bound(linkage, 1, 0.1), 0.0);  // straight
}

// A single hinge leaves its chord by r (1 - cos(step / 2)), which r step^2 / 8 bounds closely.
TEST(Linkage, TheSagittaIsBounded) {
    const Linkage linkage = crank();
    EXPECT_NEAR(sagitta_bound(linkage, 0, 0.05), 0.05 / 8.0, 1e-15);
    for (const double step : {0.01, 0.1, 0.4}) {
        for (double q = linkage.closed_q; q < -step; q += 0.05) {
            const auto at = [&](double s) {
                return Vector3d(pad_point_H(linkage, 1, q + s * step));
            };
            const Vector3d chord = at(1.0) - at(0.0);
            const Vector3d off = at(0.5) - at(0.0);
            const double sagitta = off.cross(chord).norm() / chord.norm();
            EXPECT_LE(sagitta, sagitta_bound(linkage, 1, 0.01) * step * step);
        }
    }
}

TEST(Linkage, ErrorsNameWhatIsWrong) {
    const auto detail = [](void (*break_it)(Linkage&)) {
        Linkage linkage = crank();
        break_it(linkage);
        const auto error = validate(linkage);
        return error ? error->detail : std::string("none");
    };
    EXPECT_NE(detail([](Linkage& l) { l.joints[0].parent = 1; }).find("crank.parent = 1"),
              std::string::npos);
    EXPECT_NE(detail([](Linkage& l) { l.joints[1].axis_J *= 2.0; }).find("tip.axis"),
              std::string::npos);
    EXPECT_NE(detail([](Linkage& l) { l.joints[1].offset = NAN; }).find("tip"), std::string::npos);
    EXPECT_NE(detail([](Linkage& l) { l.pads[0].joint = 2; }).find("joint 2"), std::string::npos);
    EXPECT_NE(detail([](Linkage& l) {
                  l.closed_q = 0.5;
                  l.open_q = 1.0;
              }).find("gap"),
              std::string::npos);
    EXPECT_NE(detail([](Linkage& l) { l.pads[0].point.x() = 0.05; }).find("below 0"),
              std::string::npos);
}

}  // namespace
}  // namespace graspd
