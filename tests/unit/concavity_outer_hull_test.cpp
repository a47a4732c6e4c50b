#include "graspd/concavity/outer_hull.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "graspd/base/stop.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;

double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0;
}

OuterHull hull_of(const std::vector<Vector3d>& points) {
    auto hull = outer_hull(points);
    EXPECT_TRUE(hull.ok()) << hull.error().detail;
    return hull.ok() ? std::move(hull).value() : OuterHull{};
}

double diagonal_m(const std::vector<Vector3d>& points) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : points) box.extend(point);
    return box.diagonal().norm();
}

/// Area of a regular polygon over that of the circle through its corners.
double polygon_share(double sides) {
    const double angle = 2.0 * std::numbers::pi / sides;
    return std::sin(angle) / angle;
}

/// Corners of the rings: vertices at the greatest distance from z at the height of the first such.
double sides_of(const TriangleMesh& mesh) {
    double radius = 0.0, height = 0.0;
    for (const Vector3d& v : mesh.vertices) {
        if (v.head<2>().norm() <= radius + 1e-12) continue;
        radius = v.head<2>().norm();
        height = v.z();
    }
    return static_cast<double>(std::ranges::count_if(mesh.vertices, [&](const Vector3d& v) {
        return std::abs(v.z() - height) < 1e-12 && std::abs(v.head<2>().norm() - radius) < 1e-12;
    }));
}

struct KnownHull {
    const char* name;
    TriangleMesh mesh;
    double volume_m3;
};
std::vector<KnownHull> known_hulls(std::size_t faces) {
    constexpr double kPi = std::numbers::pi;
    const TriangleMesh cup = test::cup(0.04, 0.09, 0.004, faces);
    const TriangleMesh hourglass = test::hourglass(0.04, 0.01, 0.05, 0.015, faces);
    return {
        {"box", test::box({0.1, 0.2, 0.3}, faces), 0.006},
        {"channel", test::u_channel(0.05, 0.03, 0.005, 0.08, faces), 0.04 * 0.055 * 0.08},
        {"hole", test::blind_hole_block({0.06, 0.08, 0.05}, 0.02, 0.03, faces), 0.06 * 0.08 * 0.05},
        // The square 6 x 8 without the triangle 5 x 7 that the slanted plane cuts off.
        {"L", test::l_shape(0.06, 0.08, 0.01, 0.05, faces), 0.05 * (48.0 - 17.5) * 1e-4},
        {"cup", cup, kPi * 0.04 * 0.04 * 0.09 * polygon_share(sides_of(cup))},
        {"hourglass", hourglass, kPi * 0.04 * 0.04 * 0.08 * polygon_share(sides_of(hourglass))},
    };
}

// Volumes worked by hand; every point on the inner side of every facet, by brute force; each facet
// touched by at least three of its points; unit normals that point away from the middle.
TEST(OuterHull, EnclosesKnownVolumes) {
    for (const std::size_t faces : {300u, 5000u}) {
        for (const auto& [name, mesh, volume_m3] : known_hulls(faces)) {
            for (const double shift_m : {0.0, 200.0}) {
                SCOPED_TRACE(std::string(name) + " at " + std::to_string(shift_m));
                Eigen::Isometry3d pose = test::random_pose(faces);
                pose.pretranslate(Vector3d(shift_m, -shift_m, shift_m));
                const TriangleMesh moved = test::moved(mesh, pose);
                const OuterHull hull = hull_of(moved.vertices);
                const double size_m = diagonal_m(moved.vertices);
                const double rounding = 1e-12 * size_m + 1e-15 * 3.0 * shift_m;
                EXPECT_NEAR(hull.volume_m3, volume_m3, 1e-9 * volume_m3);
                for (const HullFacet& facet : hull.facets) {
                    EXPECT_NEAR(facet.normal.norm(), 1.0, 1e-12);
                    int touching = 0;
                    for (const Vector3d& p : moved.vertices) {
                        const double height = facet.normal.dot(p) - facet.offset_m;
                        ASSERT_LT(height, rounding);
                        touching += height > -rounding;
                    }
                    EXPECT_GE(touching, 3);
                }
            }
        }
    }
}

// Coplanar triangles are merged: a box has 6 facets and 8 vertices however finely it is cut, and
// the facets' boxes are its sides.
TEST(OuterHull, MergesCoplanarTriangles) {
    const Vector3d size(0.1, 0.2, 0.3);
    const TriangleMesh mesh = test::box(size, 3000);
    const OuterHull hull = hull_of(mesh.vertices);
    EXPECT_EQ(hull.facets.size(), 6u);
    EXPECT_EQ(hull.vertices.size(), 8u);
    EXPECT_TRUE(std::ranges::is_sorted(hull.vertices));
    for (const std::uint32_t v : hull.vertices) {
        EXPECT_LT((mesh.vertices[v].cwiseAbs() - 0.5 * size).norm(), 1e-12);
    }
    std::set<std::pair<int, bool>> sides;
    for (const HullFacet& facet : hull.facets) {
        int axis = 0;
        EXPECT_NEAR(facet.normal.cwiseAbs().maxCoeff(&axis), 1.0, 1e-12);
        EXPECT_NEAR(facet.offset_m, 0.5 * size[axis], 1e-12);
        EXPECT_LT(facet.box.sizes()[axis], 1e-12);
        EXPECT_NEAR(facet.box.sizes().sum(), size.sum() - size[axis], 1e-12);
        sides.emplace(axis, facet.normal[axis] > 0);
    }
    EXPECT_EQ(sides.size(), 6u);
}

// Points on a sphere are all vertices; points inside are none.
TEST(OuterHull, NamesTheVerticesThatSpanIt) {
    std::mt19937_64 random(5);
    std::vector<Vector3d> points;
    std::vector<std::uint32_t> on_sphere;
    while (points.size() < 600) {
        const Vector3d p(fraction(random), fraction(random), fraction(random));
        if (p.norm() < 0.2) continue;
        const bool on = points.size() % 3 == 0;
        if (on) on_sphere.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back((on ? 1.0 : 0.7) * p.normalized());
    }
    EXPECT_EQ(hull_of(points).vertices, on_sphere);
}

// qhull is asked to stop through its reports; that they are read changes nothing.
TEST(OuterHull, CanBeStoppedWithinAndGivesTheSameOtherwise) {
    std::mt19937_64 random(6);
    std::vector<Vector3d> points;
    for (int i = 0; i < 20000; ++i) {
        points.push_back(
            Vector3d(fraction(random), fraction(random), fraction(random)).normalized());
    }
    const OuterHull whole = hull_of(points);
    std::size_t calls = 0, allowed = std::numeric_limits<std::size_t>::max();
    const StopQuery query = [&] { return ++calls > allowed; };
    const StopScope scope(query);
    const OuterHull again = hull_of(points);
    EXPECT_EQ(again.vertices, whole.vertices);
    EXPECT_EQ(again.facets.size(), whole.facets.size());
    const std::size_t all = calls;
    EXPECT_GT(all, 50U);
    for (allowed = 0; allowed < all; allowed += 1 + all / 20) {
        calls = 0;
        EXPECT_THROW((void)outer_hull(points), Stopped) << allowed;
        EXPECT_LE(calls, allowed + 3) << allowed;  // a report has some lines
    }
}

TEST(OuterHull, RefusesWhatHasNoVolume) {
    const auto error_of = [](const std::vector<Vector3d>& points) {
        const auto hull = outer_hull(points);
        EXPECT_FALSE(hull.ok());
        return hull.ok() ? PlanError{} : hull.error();
    };
    EXPECT_EQ(error_of({}).code, PlanErrorCode::kDegenerate);
    const PlanError three = error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(three.code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(three.detail, testing::HasSubstr("4 points, got 3"));
    std::vector<Vector3d> plane, line;
    const Eigen::Isometry3d pose = test::random_pose(2);
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 10; ++j) plane.push_back(pose * Vector3d(i, j, 0));
        line.push_back(pose * Vector3d(i, i, i));
    }
    EXPECT_EQ(error_of(plane).code, PlanErrorCode::kDegenerate);
    EXPECT_THAT(error_of(plane).detail, testing::HasSubstr("no convex hull of 100 points: QH"));
    EXPECT_EQ(error_of(line).code, PlanErrorCode::kDegenerate);
    EXPECT_EQ(error_of(std::vector<Vector3d>(9, Vector3d::Ones())).code,
              PlanErrorCode::kDegenerate);
}

// The nearest plane against all planes one by one, for points all over the hull's inside, for
// its vertices (distance 0), and a thousand diagonals away.
TEST(HullPlaneTree, AgreesWithEveryPlaneOneByOne) {
    std::vector<TriangleMesh> meshes = {test::box({0.1, 0.2, 0.3}, 12), test::sphere(0.05, 4000),
                                        test::torus(0.06, 0.02, 3000),
                                        test::dumbbell(0.03, 0.01, 0.12, 3000)};
    Eigen::Isometry3d far = test::random_pose(6);
    far.pretranslate(Vector3d(90, -150, 120));
    meshes.push_back(test::moved(test::bowl(0.07, 0.005, 3000), far));
    for (const TriangleMesh& mesh : meshes) {
        const OuterHull hull = hull_of(mesh.vertices);
        const HullPlaneTree tree(hull);
        const double size_m = diagonal_m(mesh.vertices);
        std::mt19937_64 random(9);
        const auto pick = [&] { return mesh.vertices[random() % mesh.vertices.size()]; };
        for (int i = 0; i < 1000; ++i) {
            const double a = std::abs(fraction(random)), b = std::abs(fraction(random));
            const Vector3d p = a * pick() + (1 - a) * (b * pick() + (1 - b) * pick());
            double least = 1e9;
            for (const HullFacet& facet : hull.facets) {
                least = std::min(least, std::max(0.0, facet.offset_m - facet.normal.dot(p)));
            }
            const auto nearest = tree.nearest(p);
            EXPECT_NEAR(nearest.distance_m, least, 1e-12 * size_m);
            const HullFacet& facet = tree.facet(nearest.facet);
            EXPECT_NEAR(facet.offset_m - facet.normal.dot(p), least, 1e-12 * size_m);
        }
        for (const std::uint32_t v : hull.vertices) {
            EXPECT_LT(tree.nearest(mesh.vertices[v]).distance_m, 1e-12 * size_m + 1e-12);
        }
    }
}

// The middle of a cube is as far from all six planes: the lowest index is named.
TEST(HullPlaneTree, TiesGoToTheLowerFacet) {
    const OuterHull hull = hull_of(test::box({2, 2, 2}, 12).vertices);
    EXPECT_EQ(HullPlaneTree(hull).nearest(Vector3d::Zero()).facet, 0u);
    EXPECT_EQ(HullPlaneTree(hull).nearest(Vector3d::Zero()).distance_m, 1.0);
}

// A hint only saves time.
TEST(HullPlaneTree, AnyHintGivesTheSame) {
    const TriangleMesh mesh = test::torus(0.06, 0.02, 2000);
    const OuterHull hull = hull_of(mesh.vertices);
    const HullPlaneTree tree(hull);
    for (std::size_t v = 0; v < mesh.vertices.size(); v += 7) {
        const auto plain = tree.nearest(mesh.vertices[v]);
        for (std::uint32_t hint = 0; hint < hull.facets.size(); hint += 97) {
            const auto hinted = tree.nearest(mesh.vertices[v], hint);
            EXPECT_EQ(hinted.facet, plain.facet);
            EXPECT_EQ(hinted.distance_m, plain.distance_m);
        }
    }
}

// Points near one another share the search; each gets what it gets alone. Random points, where no
// two share planes, vertices in a row, where most do, and the middle of a ball, where all planes
// are as near.
TEST(HullPlaneTree, ManyPointsGiveTheSameAsOneByOne) {
    for (const TriangleMesh& mesh :
         {test::box({0.1, 0.2, 0.3}, 12), test::sphere(0.05, 4000), test::torus(0.06, 0.02, 3000),
          test::bowl(0.07, 0.005, 3000)}) {
        const OuterHull hull = hull_of(mesh.vertices);
        const HullPlaneTree tree(hull);
        std::vector<Vector3d> points = mesh.vertices;
        Eigen::AlignedBox3d box;
        for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
        const Vector3d middle = box.center();
        std::mt19937_64 random(12);
        for (int i = 0; i < 500; ++i) {
            const Vector3d& vertex = mesh.vertices[random() % mesh.vertices.size()];
            points.push_back(middle + std::abs(fraction(random)) * (vertex - middle));
        }
        for (int i = 0; i < 40; ++i) points.push_back(middle + Vector3d(1e-7 * i, 0, 0));
        std::vector<HullPlaneTree::Nearest> nearest(points.size());
        tree.nearest(points, nearest);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(nearest[i].distance_m, tree.nearest(points[i]).distance_m);
            const HullFacet& facet = tree.facet(nearest[i].facet);
            EXPECT_EQ(std::max(0.0, facet.offset_m - facet.normal.dot(points[i])),
                      nearest[i].distance_m);
        }
    }
}

// The facet by which a ray leaves, against every plane one by one.
TEST(HullPlaneTree, FindsWhereARayLeaves) {
    for (const TriangleMesh& mesh : {test::box({0.1, 0.2, 0.3}, 12), test::sphere(0.05, 4000),
                                     test::torus(0.06, 0.02, 2000)}) {
        const OuterHull hull = hull_of(mesh.vertices);
        const HullPlaneTree tree(hull);
        std::mt19937_64 random(10);
        for (int i = 0; i < 1000; ++i) {
            const Vector3d from = 0.5 * mesh.vertices[random() % mesh.vertices.size()];
            const Vector3d along =
                Vector3d(fraction(random), fraction(random), fraction(random)).normalized();
            const auto length_m = [&](const HullFacet& facet) {
                const double slope = facet.normal.dot(along);
                return slope > 0.0 ? (facet.offset_m - facet.normal.dot(from)) / slope : 1e9;
            };
            double least_m = 1e9;
            for (const HullFacet& facet : hull.facets) {
                least_m = std::min(least_m, length_m(facet));
            }
            EXPECT_NEAR(length_m(tree.facet(tree.exit(from, along))), least_m, 1e-9);
        }
    }
}

// Facets ahead of a point in a box, by hand: from the floor's middle, looking up, the four sides
// and the top are ahead; the bottom, behind, is not; the top is farther than a limit of 0.15.
TEST(HullPlaneTree, NamesTheFacetsAhead) {
    const OuterHull hull = hull_of(test::box({0.2, 0.2, 0.4}, 12).vertices);
    const HullPlaneTree tree(hull);
    const Vector3d floor(0.0, 0.0, -0.1);
    std::vector<std::uint32_t> facets;
    const auto normals_ahead = [&](double limit_m, double below) {
        tree.facets_ahead(floor, limit_m, Vector3d::UnitZ(), below, 1e-3, 64, facets);
        double up = 0.0;
        for (const std::uint32_t facet : facets) up += tree.facet(facet).normal.z();
        return std::pair(facets.size(), std::round(up));
    };
    EXPECT_EQ(normals_ahead(1.0, 0.1), std::pair(std::size_t{5}, 1.0));
    EXPECT_EQ(normals_ahead(1.0, 1.0), std::pair(std::size_t{6}, 0.0));
    EXPECT_EQ(normals_ahead(0.15, 0.1), std::pair(std::size_t{4}, 0.0));
    EXPECT_EQ(normals_ahead(0.05, 1.0), std::pair(std::size_t{0}, 0.0));
}

// Of more facets ahead than are asked for, the nearest are among those named.
TEST(HullPlaneTree, NamesTheNearestFacetsAhead) {
    constexpr std::size_t kMost = 5;
    const TriangleMesh mesh = test::bowl(0.07, 0.005, 4000);
    const OuterHull hull = hull_of(mesh.vertices);
    const HullPlaneTree tree(hull);
    std::vector<std::uint32_t> all, some;
    std::size_t of = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); v += 11) {
        const Vector3d& from = mesh.vertices[v];
        const auto distance_m = [&](std::uint32_t index) {
            return tree.facet(index).offset_m - tree.facet(index).normal.dot(from);
        };
        tree.facets_ahead(from, 0.1, Vector3d::UnitZ(), 0.3, 1e-3, kMost, some);
        all.clear();
        for (std::uint32_t f = 0; f < tree.size(); ++f) {
            const Vector3d foot = from + distance_m(f) * tree.facet(f).normal;
            const bool is_ahead = tree.facet(f).normal.z() > -0.299 && distance_m(f) < 0.0999 &&
                                  tree.facet(f).box.exteriorDistance(foot) == 0.0;
            if (is_ahead) all.push_back(f);
        }
        std::ranges::sort(all, {}, distance_m);
        for (std::size_t k = 0; k < std::min(kMost, all.size()); ++k) {
            EXPECT_THAT(some, testing::Contains(all[k]));
        }
        of += all.size();
    }
    EXPECT_GT(of, 50u);
}

}  // namespace
}  // namespace graspd
