#include <gtest/gtest.h>

#include <numbers>

#include "edge_contact.hpp"
#include "graspd/simulate/box_contacts.hpp"
#include "solid.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

struct Surface {
    TriangleMesh mesh;
    TriangleBvh bvh;
    explicit Surface(TriangleMesh triangles) : mesh(std::move(triangles)), bvh(mesh, 1e-9) {}
    std::vector<BoxContact> touch(const OrientedBox& box) const {
        return box_contacts(mesh, bvh, box);
    }
};

OrientedBox box_at(const Vector3d& center, const Vector3d& half) {
    OrientedBox box;
    box.pose.translation() = center;
    box.half_extent = half;
    return box;
}

// A pad of 20 x 20 mm stands 0.3 mm deep in the side of a block at x = 0.05: every contact has that
// depth and the pad's normal, and by symmetry their mean is the pad's middle, however finely the
// side is cut.
TEST(BoxContacts, PadOnFlatSideHasItsDepthEverywhere) {
    for (const std::size_t faces : {12u, 3000u}) {
        const Surface block(test::box({0.1, 0.1, 0.1}, faces));
        const auto contacts =
            block.touch(box_at({0.05 + 0.005 - 0.0003, 0.003, -0.004}, {0.005, 0.01, 0.01}));
        ASSERT_GE(contacts.size(), 4u);
        Vector3d sum = Vector3d::Zero();
        for (const BoxContact& contact : contacts) {
            EXPECT_NEAR(contact.depth_m, 0.0003, 1e-12);
            EXPECT_NEAR((contact.normal + Vector3d::UnitX()).norm(), 0.0, 1e-12);
            EXPECT_NEAR(contact.point.x(), 0.05, 1e-12);
            sum += contact.point;
        }
        EXPECT_NEAR((sum / double(contacts.size()) - Vector3d(0.05, 0.003, -0.004)).norm(), 0.0,
                    1e-9);
    }
}

TEST(BoxContacts, NoneBeforeItTouches) {
    const Surface block(test::box({0.1, 0.1, 0.1}));
    EXPECT_TRUE(block.touch(box_at({0.05 + 0.005 + 1e-6, 0, 0}, {0.005, 0.01, 0.01})).empty());
}

// A box that lies on an edge, turned by 45 degrees about y: its rounded edge reaches
// sqrt(2) (half - rounding) + rounding from its middle, and the normal is the flat side's.
TEST(BoxContacts, EdgeOnFlatSideHasTheSidesNormal) {
    const Surface block(test::box({0.1, 0.1, 0.1}));
    constexpr double kHalf = 0.01, kRounding = BoxContactConfig{}.rounding_m, kDepth = 0.0002;
    const double reach = std::numbers::sqrt2 * (kHalf - kRounding) + kRounding;
    OrientedBox box = box_at({0, 0, 0.05 + reach - kDepth}, Vector3d::Constant(kHalf));
    box.pose.rotate(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3d::UnitY()));
    const auto contacts = block.touch(box);
    ASSERT_FALSE(contacts.empty());
    for (const BoxContact& contact : contacts) {
        EXPECT_NEAR(contact.depth_m, kDepth, 1e-12);
        EXPECT_NEAR((contact.normal + Vector3d::UnitZ()).norm(), 0.0, 1e-9);
    }
}

// Turned so that a corner points down: one contact, though three edges end there.
TEST(BoxContacts, CornerOnFlatSideIsOneContact) {
    const Surface block(test::box({0.1, 0.1, 0.1}));
    constexpr double kHalf = 0.01, kRounding = BoxContactConfig{}.rounding_m, kDepth = 0.0002;
    const double reach = std::numbers::sqrt3 * (kHalf - kRounding) + kRounding;
    OrientedBox box = box_at({0.01, 0.02, 0.05 + reach - kDepth}, Vector3d::Constant(kHalf));
    box.pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), -Vector3d::UnitZ())
                            .toRotationMatrix();
    const auto contacts = block.touch(box);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].depth_m, kDepth, 1e-9);
    EXPECT_NEAR((contacts[0].point - Vector3d(0.01, 0.02, 0.05)).norm(), 0.0, 1e-9);
}

// A finger in a cup's cavity touches nothing, where the hull would be all around it; half a
// millimetre into the wall it has contacts whose normals point outward to the wall.
TEST(BoxContacts, FingerInCavityTouchesOnlyTheWall) {
    constexpr double kRadius = 0.04, kWall = 0.004;
    const Surface cup(test::cup(kRadius, 0.1, kWall, 4000));
    const Vector3d half(0.005, 0.004, 0.02);
    EXPECT_TRUE(cup.touch(box_at({0, 0, 0.06}, half)).empty());
    // The pad's sides at y = +-0.004 meet the wall first: there it stands at x = 0.03578.
    const double inside = std::sqrt(std::pow(kRadius - kWall, 2) - std::pow(half.y(), 2));
    const auto contacts = cup.touch(box_at({inside - half.x() + 0.0005, 0, 0.06}, half));
    ASSERT_FALSE(contacts.empty());
    for (const BoxContact& contact : contacts) {
        EXPECT_GT(contact.normal.x(), 0.5);
        EXPECT_GT(contact.point.x(), 0.03);
    }
}

// A wall of 0.1 mm that is pressed in by 0.2 mm lies wholly in the box: only its near side counts,
// so that it is pushed back the way it came with its full depth.
TEST(BoxContacts, ThinWallHasOneSide) {
    const Surface sheet(test::box({0.0001, 0.1, 0.1}));
    const auto contacts =
        sheet.touch(box_at({0.00005 + 0.005 - 0.0002, 0, 0}, {0.005, 0.01, 0.01}));
    ASSERT_FALSE(contacts.empty());
    for (const BoxContact& contact : contacts) {
        EXPECT_NEAR(contact.normal.x(), -1.0, 1e-12);
        EXPECT_NEAR(contact.depth_m, 0.0002, 1e-12);
    }
}

// A box of 2 a, 2 b, 2 c has (b2 + c2) / 3 per mass about x; its centre is where it was put.
TEST(Solid, BoxHasItsMoments) {
    TriangleMesh mesh = test::box({0.2, 0.4, 0.6});
    for (Vector3d& vertex : mesh.vertices) vertex += Vector3d(1, 2, 3);
    const auto solid = simulate_detail::solid_of(mesh);
    EXPECT_NEAR(solid.volume_m3, 0.048, 1e-12);
    EXPECT_NEAR((solid.center - Vector3d(1, 2, 3)).norm(), 0.0, 1e-12);
    const Vector3d expected(0.13 / 3.0, 0.10 / 3.0, 0.05 / 3.0);
    EXPECT_NEAR((solid.inertia_m2 - Eigen::Matrix3d(expected.asDiagonal())).norm(), 0.0, 1e-12);
}

// Over the triangle's middle, beside an edge, through it, and along one of its edges.
TEST(NearestPoints, OfSegmentAndTriangle) {
    const simulate_detail::Corners t{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)};
    const auto distance = [&](const Vector3d& a, const Vector3d& b) {
        const auto pair = simulate_detail::nearest_points(a, b, t);
        return (pair.on_segment - pair.on_triangle).norm();
    };
    EXPECT_NEAR(distance({1, 1, 2}, {1, 1, 5}), 2.0, 1e-12);
    EXPECT_NEAR(distance({-3, 1, 4}, {-3, 3, 4}), 5.0, 1e-12);
    EXPECT_NEAR(distance({1, 1, -1}, {1, 1, 1}), 0.0, 1e-12);
    EXPECT_NEAR(distance({1, -1, 0}, {3, -1, 0}), 1.0, 1e-12);
    EXPECT_NEAR(distance({5, 5, 0}, {5, 5, 0}), 3.0 * std::numbers::sqrt2, 1e-12);
}

}  // namespace
}  // namespace graspd
