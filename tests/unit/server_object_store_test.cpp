#include "object_store.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "support/shapes.hpp"

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
    store.put("a", seen, nullptr);
    store.put("b", TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, nullptr);
    const auto a = store.find("a").geometry;
    ASSERT_NE(a, nullptr);
    EXPECT_EQ(std::get<PointCloud>(*a).points[1], Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(std::get<PointCloud>(*a).sensor_origin, Eigen::Vector3d(0, 0, 9));
    const auto b = store.find("b").geometry;
    ASSERT_NE(b, nullptr);
    EXPECT_EQ(std::get<TriangleMesh>(*b).faces.size(), 1u);
    EXPECT_EQ(store.find("c").geometry, nullptr);
}

// Bytes by hand: a mesh of 3 vertices and 1 face has 3 x 24 + 12 = 84, a point 24.
TEST(ObjectStore, CountsBytes) {
    EXPECT_EQ(geometry_bytes(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), 84u);
    ObjectStore store(10000);
    store.put("a", cloud(10), nullptr);
    store.put("a", cloud(10), nullptr);  // known: counted once
    EXPECT_EQ(store.bytes(), 240u);
}

// Room for 100 points. a, b, c of 40 each: c drives out a, unless a was asked for after b.
TEST(ObjectStore, TheOneNotAskedForLongestGoesFirst) {
    ObjectStore store(100 * 24);
    store.put("a", cloud(40), nullptr);
    store.put("b", cloud(40), nullptr);
    ASSERT_NE(store.find("a").geometry, nullptr);
    store.put("c", cloud(40), nullptr);
    EXPECT_NE(store.find("a").geometry, nullptr);
    EXPECT_EQ(store.find("b").geometry, nullptr);
    EXPECT_NE(store.find("c").geometry, nullptr);
    EXPECT_EQ(store.bytes(), 80u * 24);
}

TEST(ObjectStore, OneLargerThanTheStoreIsNotKeptAndDrivesNothingOut) {
    ObjectStore store(100 * 24);
    store.put("a", cloud(40), nullptr);
    store.put("huge", cloud(101), nullptr);
    EXPECT_EQ(store.find("huge").geometry, nullptr);
    EXPECT_NE(store.find("a").geometry, nullptr);
    store.put("exact", cloud(100), nullptr);
    EXPECT_NE(store.find("exact").geometry, nullptr);
    EXPECT_EQ(store.find("a").geometry, nullptr);
}

TEST(ObjectStore, WhoHoldsAnObjectKeepsItWhenTheStoreDropsIt) {
    ObjectStore store(100 * 24);
    store.put("a", cloud(60), nullptr);
    const auto held = store.find("a").geometry;
    store.put("b", cloud(60), nullptr);
    EXPECT_EQ(store.find("a").geometry, nullptr);
    EXPECT_EQ(std::get<PointCloud>(*held).points.size(), 60u);
}

PreparedObjectPtr prepared(const ObjectGeometry& geometry) {
    return prepare(geometry, {}).value();
}

TEST(ObjectStore, APreparedObjectCountsAndLeavesWithItsGeometry) {
    const ObjectGeometry box = graspd::test::box({0.06, 0.04, 0.02}, 300);
    const PreparedObjectPtr of_box = prepared(box);
    const std::uint64_t bytes = geometry_bytes(box) + memory_bytes(*of_box);
    ObjectStore store(bytes + 24);
    store.put("box", box, of_box);
    EXPECT_EQ(store.bytes(), bytes);
    EXPECT_EQ(store.find("box").prepared, of_box);
    store.put("a", cloud(1), nullptr);
    EXPECT_EQ(store.size(), 2u);
    store.put("b", cloud(1), nullptr);  // no room: the box is the oldest
    EXPECT_EQ(store.find("box").geometry, nullptr);
    EXPECT_EQ(store.bytes(), 48u);
}

TEST(ObjectStore, APreparedObjectWithoutRoomIsLeftOut) {
    const ObjectGeometry box = graspd::test::box({0.06, 0.04, 0.02}, 300);
    ObjectStore store(geometry_bytes(box) + 10);
    store.put("box", box, prepared(box));
    EXPECT_NE(store.find("box").geometry, nullptr);
    EXPECT_EQ(store.find("box").prepared, nullptr);
    EXPECT_EQ(store.bytes(), geometry_bytes(box));
}

TEST(ObjectStore, OfTwoPreparedAtOnceTheFirstStays) {
    const ObjectGeometry box = graspd::test::box({0.06, 0.04, 0.02}, 300);
    const PreparedObjectPtr first = prepared(box);
    ObjectStore store(1 << 20);
    store.put("box", box, nullptr);
    EXPECT_EQ(store.find("box").prepared, nullptr);
    store.put("box", box, first);
    store.put("box", box, prepared(box));
    EXPECT_EQ(store.find("box").prepared, first);
    EXPECT_EQ(store.bytes(), geometry_bytes(box) + memory_bytes(*first));
    store.put("box", box, nullptr);
    EXPECT_EQ(store.find("box").prepared, first);
}

// Two objects under one key, as only somebody who makes them so on purpose has: a request that
// brings its geometry gets its own, one that names the key gets neither.
TEST(ObjectStore, OneKeyOfTwoObjectsNamesNeither) {
    const ObjectGeometry a = cloud(2);
    PointCloud seen = cloud(2);
    seen.sensor_origin = Eigen::Vector3d(0, 0, 1);
    const ObjectGeometry mesh = TriangleMesh{std::get<PointCloud>(a).points, {}};
    ObjectStore store(10000);
    store.put("key", a, nullptr);
    EXPECT_NE(store.find("key", a).geometry, nullptr);
    EXPECT_EQ(store.find("key", seen).geometry, nullptr);
    EXPECT_EQ(store.find("key", mesh).geometry, nullptr);
    EXPECT_NE(store.find("key").geometry, nullptr);
    store.put("key", seen, nullptr);
    EXPECT_EQ(store.find("key").geometry, nullptr);
    EXPECT_EQ(store.find("key", a).geometry, nullptr);
    EXPECT_EQ(store.bytes(), 0u);
    store.put("key", a, nullptr);
    EXPECT_EQ(store.find("key").geometry, nullptr);
}

// NaN differs from itself and 0 equals -0, but bytes are bytes.
TEST(ObjectStore, ComparesBytes) {
    PointCloud nan = cloud(1);
    nan.points[0].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(same_geometry(nan, PointCloud(nan)));
    PointCloud minus = cloud(1);
    minus.points[0].x() = -0.0;
    EXPECT_FALSE(same_geometry(minus, cloud(1)));
    EXPECT_FALSE(same_geometry(cloud(1), cloud(2)));
    EXPECT_TRUE(same_geometry(TriangleMesh{}, TriangleMesh{}));
}

// Four threads put and find five objects in a store that holds three: no count drifts.
TEST(ObjectStore, ServesManyThreads) {
    ObjectStore store(3 * 100 * 24);
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t) {
            threads.emplace_back([&store, t] {
                for (int i = 0; i < 500; ++i) {
                    const std::string key = std::to_string((i * (t + 1)) % 5);
                    PointCloud object = cloud(100);
                    object.points[0].x() = std::stod(key);
                    if (const auto known = store.find(key, object).geometry) {
                        EXPECT_TRUE(same_geometry(*known, object));
                    }
                    store.put(key, std::move(object), nullptr);
                }
            });
        }
    }
    EXPECT_EQ(store.size(), 3u);
    EXPECT_EQ(store.bytes(), 3u * 100 * 24);
}

}  // namespace
}  // namespace graspd::server
