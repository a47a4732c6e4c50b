#include "graspd/base/triangle_bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 1e-6;  // [1] of the diagonal, as the concavity stage has it

double diagonal_m(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
    return box.diagonal().norm();
}

TriangleBvh bvh_of(const TriangleMesh& mesh) {
    return {mesh, kTolerance * diagonal_m(mesh)};
}

/// In [-1, 1), the same with every standard library.
double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0;
}
Vector3d random_vector(std::mt19937_64& random) {
    return {fraction(random), fraction(random), fraction(random)};
}

// What lies beyond a float's range is in nobody's way, and spoils nothing.
TEST(TriangleBvh, CornersTooFarForAFloat) {
    TriangleMesh mesh = test::sphere(0.05, 2000);
    const TriangleMesh block = test::box({1.0, 1.0, 1.0}, 200);
    for (const double x_m : {1e200, -1e200}) {
        const Eigen::Isometry3d far(Eigen::Translation3d(x_m, 1e100, 1e300));
        mesh = test::joined(mesh, test::moved(block, far));
    }
    const TriangleBvh bvh(mesh, 1e-9);
    const auto hit = bvh.first_hit({0.0, 0.0, 1.0}, -Vector3d::UnitZ(), 2.0);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance_m, 0.95, 1e-3);
}

// The reference: every triangle, by the signs of tetrahedra's volumes in long double, without a
// tree and without a tolerance.
using Vector3l = Eigen::Matrix<long double, 3, 1>;

/// Where the segment from a to b meets the triangle, as a share of its length, or -1.
long double crossing(const TriangleMesh& mesh, const Triangle& face, const Vector3d& a,
                     const Vector3d& b) {
    std::array<Vector3l, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
        v[k] = mesh.vertices[face[k]].cast<long double>() - a.cast<long double>();
    }
    const Vector3l d = (b - a).cast<long double>();
    const long double s0 = d.dot(v[0].cross(v[1]));
    const long double s1 = d.dot(v[1].cross(v[2]));
    const long double s2 = d.dot(v[2].cross(v[0]));
    const bool all_up = s0 > 0 && s1 > 0 && s2 > 0;
    const bool all_down = s0 < 0 && s1 < 0 && s2 < 0;
    if (!all_up && !all_down) return -1;
    const Vector3l normal = (v[1] - v[0]).cross(v[2] - v[0]);
    const long double t = normal.dot(v[0]) / normal.dot(d);
    return t >= 0 && t <= 1 ? t : -1;
}

struct Crossing {
    double share;
    std::uint32_t face;
};
std::vector<Crossing> all_crossings(const TriangleMesh& mesh, const Vector3d& a,
                                    const Vector3d& b) {
    std::vector<Crossing> all;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const long double t = crossing(mesh, mesh.faces[f], a, b);
        if (t >= 0) all.push_back({static_cast<double>(t), f});
    }
    std::ranges::sort(all, {}, &Crossing::share);
    return all;
}

struct NamedMesh {
    const char* name;
    TriangleMesh mesh;
};
std::vector<NamedMesh> meshes() {
    Eigen::Isometry3d far = test::random_pose(5);
    far.pretranslate(Vector3d(300, -400, 500));
    TriangleMesh soup = test::torus(0.06, 0.02, 1500);
    soup = test::without(soup, test::choose_faces(soup, 200, 3));
    return {{"cup", test::moved(test::cup(0.04, 0.09, 0.004, 3000), test::random_pose(1))},
            {"hourglass", test::hourglass(0.04, 0.01, 0.05, 0.015, 2000)},
            {"channel far away", test::moved(test::u_channel(0.05, 0.03, 0.005, 0.08, 2000), far)},
            {"torus with holes", soup}};
}

// Random segments and rays against every triangle one by one. The tree may only differ where a
// segment passes an edge within the tolerance: once in some thousand segments, and never by a leak.
TEST(TriangleBvh, AgreesWithEveryTriangleOneByOne) {
    for (const auto& [name, mesh] : meshes()) {
        SCOPED_TRACE(name);
        const TriangleBvh bvh = bvh_of(mesh);
        const double size_m = diagonal_m(mesh);
        const Vector3d middle = [&] {
            Eigen::AlignedBox3d box;
            for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
            return Vector3d(box.center());
        }();
        std::mt19937_64 random(11);
        int leaks = 0, borderline = 0, hits = 0;
        TriangleBvh::Blocker blocker;
        for (int i = 0; i < 1500; ++i) {
            const Vector3d a = middle + 0.6 * size_m * random_vector(random);
            const Vector3d b = middle + 0.6 * size_m * random_vector(random);
            const auto expected = all_crossings(mesh, a, b);
            const bool blocked = bvh.segment_blocked(a, b);
            EXPECT_EQ(bvh.segment_blocked(a, b, blocker), blocked);
            EXPECT_EQ(bvh.segment_blocked(a, b, blocker), blocked);
            leaks += !blocked && !expected.empty();
            borderline += blocked && expected.empty();
            const double length = (b - a).norm();
            const auto first = bvh.first_hit(a, (b - a) / length, length);
            leaks += !first && !expected.empty();
            if (!first || expected.empty()) continue;
            ++hits;
            const double within = first->distance_m - expected.front().share * length;
            EXPECT_LT(within, 1e-9 * size_m);
            borderline += within < -1e-9 * size_m;
            const auto all = bvh.all_hits(a, (b - a) / length, length);
            borderline += all.size() != expected.size();
            if (all.size() != expected.size()) continue;
            for (std::size_t k = 0; k < all.size(); ++k) {
                EXPECT_EQ(all[k].face, expected[k].face);
                EXPECT_NEAR(all[k].distance_m, expected[k].share * length, 1e-9 * size_m);
            }
        }
        EXPECT_EQ(leaks, 0);
        EXPECT_LE(borderline, 2);
        EXPECT_GT(hits, 300);
    }
}

// The trap that a small mesh does not show: rays that meet shared vertices and edges exactly, in
// triangles of a thousandth of the diagonal, rotated and a thousand diagonals away. From outside
// a convex body to its middle there is no free way.
TEST(TriangleBvh, NothingLeaksThroughSharedEdgesAndVertices) {
    const TriangleMesh plain = test::box({0.1, 0.1, 0.1}, 70000);
    for (const double shift_m : {0.0, 100.0}) {
        Eigen::Isometry3d pose = test::random_pose(2);
        pose.pretranslate(Vector3d(shift_m, -shift_m, shift_m));
        const TriangleMesh mesh = test::moved(plain, pose);
        const TriangleBvh bvh = bvh_of(mesh);
        std::size_t leaks = 0;
        const auto shoot = [&](const Vector3d& target_O) {
            // Straight at the side, as the way to a hull plane runs.
            Vector3d outward = Vector3d::Zero();
            int axis = 0;
            target_O.cwiseAbs().maxCoeff(&axis);
            outward[axis] = target_O[axis] > 0 ? 1.0 : -1.0;
            const Vector3d from = pose * Vector3d(target_O + 0.03 * outward);
            const Vector3d to = pose * Vector3d(target_O - 0.03 * outward);
            leaks += !bvh.segment_blocked(from, to);
            leaks += !bvh.first_hit(from, (to - from).normalized(), 0.06).has_value();
        };
        for (const Vector3d& vertex : plain.vertices) shoot(vertex);
        for (const Triangle& face : plain.faces) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector3d& a = plain.vertices[face[k]];
                const Vector3d& b = plain.vertices[face[(k + 1) % 3]];
                shoot(a + 0.37 * (b - a));
            }
        }
        EXPECT_EQ(leaks, 0u) << shift_m;
    }
}

/// One triangle in the plane z = 0 with a right angle at the origin.
TriangleMesh right_triangle(double along_x_m, double along_y_m) {
    return {{{0, 0, 0}, {along_x_m, 0, 0}, {0, along_y_m, 0}}, {{0, 1, 2}}};
}
bool meets_at(const TriangleBvh& bvh, double x, double y) {
    return bvh.segment_blocked({x, y, 1.0}, {x, y, -1.0});
}

// The tolerance is a length: the triangle grows by it on every side, whatever its own size.
TEST(TriangleBvh, TheToleranceIsALength) {
    for (const double size_m : {1e-3, 1.0, 50.0}) {
        const TriangleBvh bvh(right_triangle(size_m, size_m), 1e-4);
        EXPECT_TRUE(meets_at(bvh, -0.9e-4, 0.3 * size_m));
        EXPECT_FALSE(meets_at(bvh, -1.1e-4, 0.3 * size_m));
        EXPECT_TRUE(meets_at(bvh, 0.3 * size_m, -0.9e-4));
        EXPECT_FALSE(meets_at(bvh, 0.3 * size_m, -1.1e-4));
        const double out = 1e-4 / std::sqrt(2.0);  // across the slanted side
        EXPECT_TRUE(meets_at(bvh, 0.5 * size_m + 0.9 * out, 0.5 * size_m + 0.9 * out));
        EXPECT_FALSE(meets_at(bvh, 0.5 * size_m + 1.1 * out, 0.5 * size_m + 1.1 * out));
    }
}

// A needle grows by the tolerance and no more: with one for the barycentric coordinates alone it
// would reach out 10 lengths beyond its point. Turned by 45 degrees its box is no help.
TEST(TriangleBvh, ANeedleDoesNotReachBeyondItsEnds) {
    const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
    TriangleMesh mesh = test::moved(right_triangle(1.0, 1e-5), turn);
    const TriangleBvh bvh(mesh, 1e-4);
    const auto meets = [&](double x, double y) {
        return bvh.segment_blocked(turn * Vector3d(x, y, 1.0), turn * Vector3d(x, y, -1.0));
    };
    EXPECT_TRUE(meets(0.5, 0.0));
    EXPECT_TRUE(meets(-0.9e-4, 0.0));
    EXPECT_FALSE(meets(-1.2e-4, 0.0));
    EXPECT_TRUE(meets(1.0 + 0.9e-4, 0.0));
    EXPECT_FALSE(meets(1.0 + 1.2e-4, 0.0));
    EXPECT_FALSE(meets(1.001, 0.0));
}

void expect_same(const std::optional<TriangleBvh::Hit>& expected,
                 const std::optional<TriangleBvh::Hit>& hit) {
    ASSERT_EQ(hit.has_value(), expected.has_value());
    if (!hit) return;
    EXPECT_EQ(hit->distance_m, expected->distance_m);
    EXPECT_EQ(hit->face, expected->face);
    EXPECT_EQ(hit->from_outside, expected->from_outside);
}

/// Compares hits_from_ends() with the two first_hit() of each line. @return how many lines hit
int expect_as_from_each_end(const TriangleBvh& bvh, const TriangleBvh::LineGrid& grid) {
    const auto ends = bvh.hits_from_ends(grid);
    EXPECT_EQ(ends.size(), grid.y_m.size() * grid.z_m.size());
    const Vector3d direction = grid.pose.linear().col(0);
    int hits = 0;
    std::size_t line = 0;
    for (const double y : grid.y_m) {
        for (const double z : grid.z_m) {
            const auto& [from_a, from_b] = ends.at(line++);
            const Vector3d a = grid.pose * Vector3d(-grid.half_length_m, y, z);
            const Vector3d b = grid.pose * Vector3d(grid.half_length_m, y, z);
            expect_same(bvh.first_hit(a, direction, 2.0 * grid.half_length_m), from_a);
            expect_same(bvh.first_hit(b, -direction, 2.0 * grid.half_length_m), from_b);
            hits += from_a.has_value();
        }
    }
    return hits;
}

std::vector<double> even_steps(double first, double step, std::size_t count) {
    std::vector<double> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.push_back(first + static_cast<double>(i) * step);
    }
    return places;
}

TEST(TriangleBvh, BothEndsOfALine) {
    // A block of 40 in the middle of a room of 200, seen from within the room and from outside.
    const auto room = test::box({0.2, 0.2, 0.2}, 300), block = test::box({0.04, 0.04, 0.04}, 300);
    const TriangleBvh bvh(test::joined(room, block), 1e-9);
    const std::vector<double> y{0.003}, z{0.004};
    const auto ends_of = [&](double from_x, double to_x) {
        const Eigen::Translation3d middle(0.5 * (from_x + to_x), 0.0, 0.0);
        return bvh.hits_from_ends({Eigen::Isometry3d(middle), 0.5 * (to_x - from_x), y, z}).at(0);
    };
    const auto in_room = ends_of(-0.09, 0.09);
    ASSERT_TRUE(in_room.from_a && in_room.from_b);
    EXPECT_NEAR(in_room.from_a->distance_m, 0.07, 1e-12);
    EXPECT_NEAR(in_room.from_b->distance_m, 0.07, 1e-12);
    EXPECT_TRUE(in_room.from_a->from_outside && in_room.from_b->from_outside);
    const auto across = ends_of(-0.15, 0.0);
    ASSERT_TRUE(across.from_a && across.from_b);
    EXPECT_NEAR(across.from_a->distance_m, 0.05, 1e-12);  // the room's wall
    EXPECT_TRUE(across.from_a->from_outside);
    EXPECT_NEAR(across.from_b->distance_m, 0.02, 1e-12);  // the block, from its middle
    EXPECT_FALSE(across.from_b->from_outside);
    const auto short_of_all = ends_of(-0.09, -0.03);
    EXPECT_FALSE(short_of_all.from_a || short_of_all.from_b);
}

// A block as wide as a third of the grid: a row of lines passes on either side of it.
TEST(TriangleBvh, EachLineOfAGridIsItsOwn) {
    const TriangleBvh bvh(test::box({0.04, 0.02, 0.05}, 300), 1e-9);
    const auto y = even_steps(-0.02, 0.02, 3), z = even_steps(0.0, 0.02, 2);
    const auto ends = bvh.hits_from_ends({Eigen::Isometry3d::Identity(), 0.05, y, z});
    ASSERT_EQ(ends.size(), 6U);
    for (std::size_t line = 0; line < 6; ++line) {
        const bool meets = line == 2 || line == 3;  // y = 0
        ASSERT_EQ(ends[line].from_a.has_value(), meets) << line;
        ASSERT_EQ(ends[line].from_b.has_value(), meets) << line;
        if (!meets) continue;
        EXPECT_NEAR(ends[line].from_a->distance_m, 0.03, 1e-12);
        EXPECT_NEAR(ends[line].from_b->distance_m, 0.03, 1e-12);
    }
    EXPECT_TRUE(bvh.hits_from_ends({Eigen::Isometry3d::Identity(), 0.05, y, {}}).empty());
    const TriangleBvh nothing(TriangleMesh{}, 1e-9);
    for (const auto& [a, b] : nothing.hits_from_ends({Eigen::Isometry3d::Identity(), 1.0, y, z})) {
        EXPECT_FALSE(a || b);
    }
}

TEST(TriangleBvh, BothEndsAreAsEachAlone) {
    std::mt19937_64 random(7);
    TriangleMesh shells;  // five in one another, so that most of what a line passes is in between
    for (const double radius_m : {0.01, 0.02, 0.03, 0.04, 0.05}) {
        shells = test::joined(shells, test::sphere(radius_m, 1500));
    }
    std::vector<NamedMesh> all = meshes();
    all.push_back({"shells", shells});
    all.push_back({"one triangle", {{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {{0, 1, 2}}}});
    for (const auto& [name, mesh] : all) {
        SCOPED_TRACE(name);
        const TriangleBvh bvh = bvh_of(mesh);
        const double size_m = diagonal_m(mesh);
        int hits = 0;
        for (int i = 0; i < 300; ++i) {
            Eigen::Isometry3d pose = test::random_pose(100 + static_cast<unsigned>(i));
            pose.translation() = bvh.bounds().center() + 0.3 * size_m * random_vector(random);
            const double step_m = 0.05 * size_m * (1.0 + fraction(random));
            const auto y = even_steps(0.2 * size_m * fraction(random), step_m, 1 + i % 9);
            const auto z = even_steps(0.2 * size_m * fraction(random), 0.5 * step_m, 1 + i % 5);
            const double half_m = 0.5 * size_m * (1.0 + fraction(random));
            hits += expect_as_from_each_end(bvh, {pose, half_m, y, z});
        }
        EXPECT_GT(hits, 50);
    }
}

// Both ends belong to the segment; one that ends before the triangle is free.
TEST(TriangleBvh, SegmentsAreClosed) {
    const TriangleBvh bvh(right_triangle(1.0, 1.0), 1e-6);
    EXPECT_TRUE(bvh.segment_blocked({0.2, 0.2, 1.0}, {0.2, 0.2, 0.0}));
    EXPECT_TRUE(bvh.segment_blocked({0.2, 0.2, 0.0}, {0.2, 0.2, 1.0}));
    EXPECT_FALSE(bvh.segment_blocked({0.2, 0.2, 1.0}, {0.2, 0.2, 1e-9}));
    EXPECT_FALSE(bvh.first_hit({0.2, 0.2, 1.0}, -Vector3d::UnitZ(), 0.999).has_value());
    EXPECT_TRUE(bvh.first_hit({0.2, 0.2, 1.0}, -Vector3d::UnitZ(), 1.0).has_value());
    EXPECT_TRUE(bvh.all_hits({0.2, 0.2, 1.0}, -Vector3d::UnitZ(), 0.999).empty());
}

// Rays along the triangle's plane, through it and beside it, do not count.
TEST(TriangleBvh, RaysInThePlaneDoNotHit) {
    const TriangleBvh bvh(right_triangle(1.0, 1.0), 1e-6);
    EXPECT_FALSE(bvh.segment_blocked({-1.0, 0.2, 0.0}, {2.0, 0.2, 0.0}));
    EXPECT_FALSE(bvh.segment_blocked({0.2, -1.0, 0.0}, {0.2, 2.0, 0.0}));
    EXPECT_FALSE(bvh.segment_blocked({-1.0, 0.2, 1e-5}, {2.0, 0.2, 1e-5}));
}

// Counter-clockwise from above: from above one meets the outer side.
TEST(TriangleBvh, TellsTheSides) {
    const TriangleBvh bvh(right_triangle(1.0, 1.0), 1e-6);
    const auto above = bvh.first_hit({0.2, 0.3, 2.0}, -Vector3d::UnitZ(), 9.0);
    ASSERT_TRUE(above.has_value());
    EXPECT_TRUE(above->from_outside);
    EXPECT_NEAR(above->distance_m, 2.0, 1e-15);
    const auto below = bvh.first_hit({0.2, 0.3, -3.0}, Vector3d::UnitZ(), 9.0);
    ASSERT_TRUE(below.has_value());
    EXPECT_FALSE(below->from_outside);
    EXPECT_NEAR(below->distance_m, 3.0, 1e-15);
}

// A ray along z through a box of 12 triangles, off its diagonals: in at 0.9, out at 1.1. Along the
// diagonal of both lids two faces are hit at once each, and one stands for them.
TEST(TriangleBvh, AllHitsComeInOrderAndOnce) {
    const TriangleBvh bvh(test::box({0.2, 0.2, 0.2}, 12), 1e-6);
    for (const double x : {0.03, 0.0, 0.07}) {
        const auto hits = bvh.all_hits({x, x, 1.0}, -Vector3d::UnitZ(), 2.0);
        ASSERT_EQ(hits.size(), 2u) << x;
        EXPECT_NEAR(hits[0].distance_m, 0.9, 1e-12);
        EXPECT_NEAR(hits[1].distance_m, 1.1, 1e-12);
        EXPECT_TRUE(hits[0].from_outside);
        EXPECT_FALSE(hits[1].from_outside);
    }
}

// The same face three times: the lowest index is named.
TEST(TriangleBvh, TiesGoToTheLowerFace) {
    TriangleMesh mesh = test::sphere(0.1, 500);
    const std::size_t faces = mesh.faces.size();
    mesh.faces.insert(mesh.faces.end(), mesh.faces.begin(), mesh.faces.end());
    mesh.faces.insert(mesh.faces.end(), mesh.faces.begin(), mesh.faces.end());
    const TriangleBvh bvh = bvh_of(mesh);
    std::mt19937_64 random(3);
    for (int i = 0; i < 200; ++i) {
        const Vector3d direction = random_vector(random).normalized();
        const auto hit = bvh.first_hit(Vector3d::Zero(), direction, 1.0);
        ASSERT_TRUE(hit.has_value());
        EXPECT_LT(hit->face, faces);
    }
}

// Flat faces, of which scans have many, block nothing and do no harm.
TEST(TriangleBvh, DegenerateFacesAreNeverHit) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    mesh.faces = {{0, 1, 2}, {1, 1, 1}, {0, 1, 3}};
    const TriangleBvh bvh(mesh, 1e-3);
    EXPECT_FALSE(bvh.segment_blocked({0.5, 0, 1}, {0.5, 0, -1}));
    EXPECT_FALSE(bvh.contains({0.5, 0, 0}));
    EXPECT_FALSE(TriangleBvh({}, 1e-3).segment_blocked({0.5, 0, 1}, {0.5, 0, -1}));
    EXPECT_TRUE(TriangleBvh({}, 1e-3).all_hits({0.5, 0, 1}, Vector3d::UnitX(), 9.0).empty());
}

// A thousand faces with one centre cannot be told apart by a plane; the tree must end all the same.
TEST(TriangleBvh, ManyFacesInOnePlaceAreNoTrouble) {
    TriangleMesh mesh = right_triangle(1.0, 1.0);
    for (int i = 0; i < 1000; ++i) mesh.faces.push_back({0, 1, 2});
    const TriangleBvh bvh(mesh, 1e-6);
    EXPECT_TRUE(meets_at(bvh, 0.2, 0.2));
    EXPECT_FALSE(meets_at(bvh, 0.7, 0.7));
    EXPECT_EQ(bvh.all_hits({0.2, 0.2, 1.0}, -Vector3d::UnitZ(), 2.0).size(), 1u);
}

// Directions with components of zero, or too small to be inverted, through a box of the tree's own
// axes.
TEST(TriangleBvh, AxisParallelRaysWork) {
    const TriangleMesh mesh = test::box({0.2, 0.2, 0.2}, 3000);
    const TriangleBvh bvh = bvh_of(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double tiny : {0.0, -0.0, 1e-310, -1e-310, 1e-20}) {
            for (const double side : {-1.0, 1.0}) {
                Vector3d direction = Vector3d::Constant(tiny);
                direction[axis] = side;
                for (const double at : {0.0, 0.0371, 0.1}) {  // the middle, a face, the rim
                    Vector3d origin = Vector3d::Constant(at);
                    origin[axis] = -side;
                    const auto hit = bvh.first_hit(origin, direction, 2.0);
                    ASSERT_TRUE(hit.has_value()) << axis << ' ' << tiny << ' ' << at;
                    EXPECT_NEAR(hit->distance_m, 0.9, 1e-9);
                }
            }
        }
    }
}

// Inside or outside by formula; points nearer to the surface than its chords are left out.
TEST(TriangleBvh, ContainsWhatTheFormulaSays) {
    const Eigen::Isometry3d pose = test::random_pose(8);
    const TriangleBvh torus = bvh_of(test::moved(test::torus(0.06, 0.02, 20000), pose));
    const TriangleBvh cup = bvh_of(test::moved(test::cup(0.04, 0.09, 0.005, 20000), pose));
    std::mt19937_64 random(4);
    int inside_torus = 0, inside_cup = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vector3d p = 0.1 * random_vector(random);
        const double rho = std::hypot(p.x(), p.y());
        const double from_torus = std::hypot(rho - 0.06, p.z()) - 0.02;
        if (std::abs(from_torus) > 2e-4) {
            EXPECT_EQ(torus.contains(pose * p), from_torus < 0) << p.transpose();
            inside_torus += from_torus < 0;
        }
        const double from_outside = std::max({rho - 0.04, p.z() - 0.09, -p.z()});
        const double from_inside = std::max(rho - 0.035, 0.005 - p.z());
        if (std::min(std::abs(from_outside), std::abs(from_inside)) > 2e-4) {
            EXPECT_EQ(cup.contains(pose * p), from_outside < 0 && from_inside > 0) << p.transpose();
            inside_cup += from_outside < 0 && from_inside > 0;
        }
    }
    EXPECT_GT(inside_torus, 100);
    EXPECT_GT(inside_cup, 50);
}

}  // namespace
}  // namespace graspd
