#include "object_store.hpp"

#include <gtest/gtest.h>

namespace graspd::server {
namespace {

/// A cloud of n points: 24 bytes each.
PointCloud cloud(std::size_t n) {
    PointCloud points;
    points.points.resize(n, Eigen::Vector3d::Zero());
    return points;
}

TEST(ObjectStore, GivesBackWhatWasPut) {
    ObjectStore store(10000);
    PointCloud seen = cloud(2);
    seen.points[1] = {1, 2, 3};
    seen.sensor_origin = Eigen::Vector3d(0, 0, 9);
    store.put("a", seen);
    store.put("b", TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    const auto a = store.find("a");
    ASSERT_NE(a, nullptr);
    EXPECT_EQ(std::get<PointCloud>(*a).points[1], Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(std::get<PointCloud>(*a).sensor_origin, Eigen::Vector3d(0, 0, 9));
    const auto b = store.find("b");
    ASSERT_NE(b, nullptr);
    EXPECT_EQ(std::get<TriangleMesh>(*b).faces.size(), 1u);
    EXPECT_EQ(store.find("c"), nullptr);
}

// Bytes by hand: a mesh of 3 vertices and 1 face has 3 x 24 + 12 = 84, a point 24.
TEST(ObjectStore, CountsBytes) {
    EXPECT_EQ(geometry_bytes(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), 84u);
    ObjectStore store(10000);
    store.put("a", cloud(10));
    store.put("a", cloud(10));  // known: counted once
    EXPECT_EQ(store.bytes(), 240u);
}

// Room for 100 points. a, b, c of 40 each: c drives out a, unless a was asked for after b.
TEST(ObjectStore, TheOneNotAskedForLongestGoesFirst) {
    ObjectStore store(100 * 24);
    store.put("a", cloud(40));
    store.put("b", cloud(40));
    ASSERT_NE(store.find("a"), nullptr);
    store.put("c", cloud(40));
    EXPECT_NE(store.find("a"), nullptr);
    EXPECT_EQ(store.find("b"), nullptr);
    EXPECT_NE(store.find("c"), nullptr);
    EXPECT_EQ(store.bytes(), 80u * 24);
}

TEST(ObjectStore, OneLargerThanTheStoreIsNotKeptAndDrivesNothingOut) {
    ObjectStore store(100 * 24);
    store.put("a", cloud(40));
    store.put("huge", cloud(101));
    EXPECT_EQ(store.find("huge"), nullptr);
    EXPECT_NE(store.find("a"), nullptr);
    store.put("exact", cloud(100));
    EXPECT_NE(store.find("exact"), nullptr);
    EXPECT_EQ(store.find("a"), nullptr);
}

TEST(ObjectStore, WhoHoldsAnObjectKeepsItWhenTheStoreDropsIt) {
    ObjectStore store(100 * 24);
    store.put("a", cloud(60));
    const auto held = store.find("a");
    store.put("b", cloud(60));
    EXPECT_EQ(store.find("a"), nullptr);
    EXPECT_EQ(std::get<PointCloud>(*held).points.size(), 60u);
}

}  // namespace
}  // namespace graspd::server
