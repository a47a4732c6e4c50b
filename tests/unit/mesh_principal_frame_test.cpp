#include "graspd/mesh/principal_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Isometry3d frame_of(const TriangleMesh& mesh) {
    const auto frame = principal_frame(mesh);
    EXPECT_TRUE(frame.ok()) << (frame.ok() ? "" : frame.error().detail);
    return frame.ok() ? frame.value() : Eigen::Isometry3d::Identity();
}

double difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

// Second moment of a box's surface along x, sides a, b, c: 2 b c (a/2)^2 of the two faces across,
// a^3 (b + c) / 6 of the four others. In mm: 100 long 9.0 + 15.0 = 24.0 million, 60 long 5.4 + 4.7
// = 10.1, 30 long 2.7 + 0.7 = 3.4. So the axes follow the lengths, wherever those lie.
TEST(PrincipalFrame, ABoxShowsItsLengthsInFallingOrder) {
    const Eigen::Isometry3d along_x = frame_of(test::box({0.10, 0.06, 0.03}));
    EXPECT_LT(difference(along_x, Eigen::Isometry3d::Identity()), 1e-12);

    Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
    expected.linear() << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // z is 100 long, x 60, y 30
    EXPECT_LT(difference(frame_of(test::box({0.06, 0.03, 0.10})), expected), 1e-12);

    Eigen::Isometry3d shift = Eigen::Isometry3d::Identity();
    shift.translation() << 1.0, -2.0, 3.0;
    EXPECT_LT(difference(frame_of(test::moved(test::box({0.10, 0.06, 0.03}), shift)), shift),
              1e-10);
}

/// An axis-parallel rectangle: area, middle, half lengths along all axes (0 across).
struct Rectangle {
    Vector3d middle, half;
    double area() const {
        double product = 4.0;
        for (const double h : half) product *= h > 0.0 ? h : 1.0;
        return product;
    }
};

/// The surface of test::l_shape(a, b, w, l), patch by patch; the caps in two rectangles each.
std::vector<Rectangle> l_patches(double a, double b, double w, double l) {
    const double y = 0.5 * l;
    std::vector<Rectangle> patches = {
        {{0.5 * a, 0, 0}, {0.5 * a, y, 0}},              // underside
        {{0, 0, 0.5 * b}, {0, y, 0.5 * b}},              // back
        {{a, 0, 0.5 * w}, {0, y, 0.5 * w}},              // end of the leg along x
        {{0.5 * w, 0, b}, {0.5 * w, y, 0}},              // end of the leg along z
        {{0.5 * (a + w), 0, w}, {0.5 * (a - w), y, 0}},  // inner sides
        {{w, 0, 0.5 * (b + w)}, {0, y, 0.5 * (b - w)}},
    };
    for (const double side : {-y, y}) {
        patches.push_back({{0.5 * a, side, 0.5 * w}, {0.5 * a, 0, 0.5 * w}});
        patches.push_back({{0.5 * w, side, 0.5 * (b + w)}, {0.5 * w, 0, 0.5 * (b - w)}});
    }
    return patches;
}

// The same integrals over rectangles instead of triangles: about a rectangle's middle m the mean of
// x x^T is m m^T + diag(h^2) / 3, the mean of (d . x)^3 is u^3 + u sum (d h)^2 with u = d . m.
// The L is 60 and 40 long, 8 thick and 20 wide: its y axis has the least spread, so both axes whose
// sign the third moment decides lie in the plane of the L, where it is not symmetric.
TEST(PrincipalFrame, AnLAgreesWithItsRectanglesAndTheirThirdMoment) {
    const auto patches = l_patches(0.06, 0.04, 0.008, 0.02);
    double area = 0.0;
    Vector3d center = Vector3d::Zero();
    for (const Rectangle& r : patches) {
        area += r.area();
        center += r.area() * r.middle;
    }
    center /= area;
    Matrix3d spread = Matrix3d::Zero();
    for (const Rectangle& r : patches) {
        const Vector3d m = r.middle - center;
        spread += r.area() * (m * m.transpose());
        spread += r.area() / 3.0 * Matrix3d(r.half.cwiseAbs2().asDiagonal());
    }

    const Eigen::Isometry3d frame = frame_of(test::l_shape(0.06, 0.04, 0.008, 0.02, 500));
    EXPECT_LT((frame.translation() - center).norm(), 1e-12);
    const Matrix3d turned = frame.linear().transpose() * spread * frame.linear();
    const double largest = turned(0, 0);
    EXPECT_GT(turned(0, 0), turned(1, 1));
    EXPECT_GT(turned(1, 1), turned(2, 2));
    for (const auto& [row, column] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
        EXPECT_LT(std::abs(turned(row, column)), 1e-9 * largest);
    }
    EXPECT_NEAR(std::abs(frame.linear()(1, 2)), 1.0, 1e-9);
    EXPECT_NEAR(frame.linear().determinant(), 1.0, 1e-12);
    for (const int axis : {0, 1}) {
        const Vector3d d = frame.linear().col(axis);
        double moment = 0.0;
        for (const Rectangle& r : patches) {
            const double u = d.dot(r.middle - center);
            moment += r.area() * (u * u * u + u * d.cwiseProduct(r.half).squaredNorm());
        }
        EXPECT_GT(moment, 0.0) << "axis " << axis;
        EXPECT_GT(moment, 1e-6 * area * std::pow(spread.trace() / area, 1.5)) << "axis " << axis;
    }
}

// The frame goes with the object, whatever way it lies: a turn by half a turn would swap the signs
// if they came from the world's axes.
TEST(PrincipalFrame, MovesWithTheObject) {
    const TriangleMesh mesh = test::l_shape(0.06, 0.04, 0.008, 0.02, 300);
    const Eigen::Isometry3d X_OP = frame_of(mesh);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Isometry3d X_FO = test::random_pose(seed);
        EXPECT_LT(difference(frame_of(test::moved(mesh, X_FO)), X_FO * X_OP), 1e-9) << seed;
    }
}

// A box looks the same after half a turn about any of its axes, so signs there are a matter of
// the world; the axes themselves are not.
TEST(PrincipalFrame, ASymmetricBoxMovesUpToSigns) {
    const TriangleMesh mesh = test::box({0.10, 0.06, 0.03});
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Eigen::Isometry3d X_FO = test::random_pose(seed);
        const Eigen::Isometry3d frame = frame_of(test::moved(mesh, X_FO));
        EXPECT_LT((frame.translation() - X_FO.translation()).norm(), 1e-12);
        const Matrix3d relative = X_FO.linear().transpose() * frame.linear();
        EXPECT_LT((relative.cwiseAbs() - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_NEAR(relative.determinant(), 1.0, 1e-9);
        for (const int axis : {0, 1}) {  // the largest component of each decides
            const Vector3d d = frame.linear().col(axis);
            EXPECT_EQ(d.maxCoeff(), d.cwiseAbs().maxCoeff()) << "seed " << seed;
        }
    }
}

TEST(PrincipalFrame, DependsOnTheShapeAlone) {
    const Eigen::Isometry3d X = test::random_pose(3);
    const auto l_shape = [&](std::size_t faces) {
        return test::moved(test::l_shape(0.06, 0.04, 0.008, 0.02, faces), X);
    };
    const Eigen::Isometry3d coarse = frame_of(l_shape(30));
    for (const std::size_t faces : {300, 3000, 30000}) {
        EXPECT_LT(difference(frame_of(l_shape(faces)), coarse), 1e-9) << faces;
    }
    // One half cut finely, the other coarsely, each vertex on its own: the same surface.
    TriangleMesh uneven = l_shape(30);
    const Triangle cut = uneven.faces.front();
    uneven.faces.erase(uneven.faces.begin());
    const auto& v = uneven.vertices;
    const Vector3d middle = 0.2 * v[cut[0]] + 0.5 * v[cut[1]] + 0.3 * v[cut[2]];
    const auto added = static_cast<std::uint32_t>(v.size());
    uneven.vertices.push_back(middle);
    for (std::size_t k = 0; k < 3; ++k) {
        uneven.faces.push_back({cut[k], cut[(k + 1) % 3], added});
    }
    EXPECT_LT(difference(frame_of(uneven), coarse), 1e-9);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        EXPECT_LT(difference(frame_of(test::shuffled(l_shape(300), seed)), coarse), 1e-9);
    }
}

// A wedge 20 wide below, 40 above: symmetric in x and y, so its third moment exists along z alone.
// Turned upside down its z axis must turn with it: the thin end lies on one side in P always.
TEST(PrincipalFrame, AWedgeKeepsItsThinEndOnOneSide) {
    const TriangleMesh upright = test::wedge(0.02, 0.04, 0.03, 0.10, 200);
    Eigen::Isometry3d half_turn = Eigen::Isometry3d::Identity();
    half_turn.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    const Vector3d first = frame_of(upright).linear().col(0);
    const Vector3d turned = frame_of(test::moved(upright, half_turn)).linear().col(0);
    EXPECT_NEAR(std::abs(first.z()), 1.0, 1e-9);
    EXPECT_NEAR(turned.z(), -first.z(), 1e-9);
}

TEST(PrincipalFrame, WithoutAreaThereIsNone) {
    const std::vector<TriangleMesh> flawed = {
        {{}, {}},
        {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}},  // a line
        {{{0, 0, 0}, {1, 0, 0}, {0, 1, kNaN}}, {{0, 1, 2}}},
        {{{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}}, {{0, 1, 2}}},
        {{{0, 0, 0}, {1e120, 0, 0}, {0, 1e120, 0}}, {{0, 1, 2}}},  // its spread overflows
    };
    for (std::size_t i = 0; i < flawed.size(); ++i) {
        const auto frame = principal_frame(flawed[i]);
        ASSERT_FALSE(frame.ok()) << "case " << i;
        EXPECT_EQ(frame.error().code, PlanErrorCode::kDegenerate) << "case " << i;
        EXPECT_FALSE(frame.error().detail.empty());
    }
}

TEST(Transformed, MultipliesEveryVertexAndKeepsTheFaces) {
    const TriangleMesh mesh = test::box({0.1, 0.2, 0.3});
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // x to y, y to -x
    X.translation() << 1, 2, 3;
    const TriangleMesh result = transformed(X, mesh);
    EXPECT_EQ(result.faces, mesh.faces);
    ASSERT_EQ(result.vertices.size(), mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vector3d& p = mesh.vertices[i];
        EXPECT_LT((result.vertices[i] - Vector3d(1 - p.y(), 2 + p.x(), 3 + p.z())).norm(), 1e-15);
    }
}

}  // namespace
}  // namespace graspd
