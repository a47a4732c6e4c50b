#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "bend_pool.hpp"
#include "slide_bends.hpp"
#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/mesh_damage.hpp"
#include "support/shapes.hpp"

namespace graspd::concavity_detail {
namespace {

using Eigen::Vector3d;

/// A field over a mesh whose vertices all lead straight to a hull facet.
ConcavityField straight_field(std::size_t vertices, std::int32_t parent, double value_m) {
    ConcavityField field;
    field.value_m.assign(vertices, value_m);
    field.flag.assign(vertices, ConcavityFlag::kPath);
    field.parent.assign(vertices, parent);
    return field;
}

// Two bends one after the other, and then vertex 3, whose value counts: by hand.
TEST(TakeSlid, ChainsTheBends) {
    const TriangleMesh mesh = test::box({2, 2, 2}, 12);
    const OuterHull hull = outer_hull(mesh.vertices).value();
    ConcavityField field = straight_field(mesh.vertices.size(), -1, 7.0);
    field.edge_bends.push_back({});
    const Vector3d start = mesh.vertices[0], end = mesh.vertices[3];
    const Vector3d first = start + Vector3d(3, 0, 0), second = first + Vector3d(0, 4, 0);
    take_slid({1.0, {{first, first, 0}, {second, second, 0}}, 3}, 0, field);
    const auto vertices = static_cast<std::int32_t>(mesh.vertices.size());
    EXPECT_EQ(field.parent[0], vertices + 1);  // behind the bend that was there
    EXPECT_EQ(field.edge_bends[1].parent, vertices + 2);
    EXPECT_EQ(field.edge_bends[2].parent, 3);
    EXPECT_EQ(field.value_m[0], 1.0);
    const PathGround ground(mesh, {});
    EXPECT_NEAR(length_of_way(field, ground, HullPlaneTree(hull), 0),
                3.0 + 4.0 + (end - second).norm() + 7.0, 1e-12);
}

TEST(TakeSlid, LeadsStraightOnWhenAllBendsWereDropped) {
    ConcavityField field = straight_field(4, 2, 7.0);
    take_slid({0.5, {}, -3}, 1, field);
    EXPECT_EQ(field.parent[1], -3);
    EXPECT_EQ(field.value_m[1], 0.5);
    EXPECT_TRUE(field.edge_bends.empty());
}

// What the pool names, four at a time in single precision, against the conditions one by one in
// double precision, with a margin for what lies on a border.
TEST(BendPool, NamesWhatEveryConditionAllows) {
    const TriangleMesh mesh =
        test::moved(test::concavity_answer("labyrinth", 3000).mesh, test::random_pose(5));
    const test::ConcavityRun run = test::run_concavity(mesh);
    // Ways over vertices alone: those with edge bends lead to their own vertex' plane here.
    ConcavityField field = run.field;
    const auto vertices = static_cast<std::int32_t>(mesh.vertices.size());
    for (std::int32_t& parent : field.parent) parent = parent >= vertices ? -1 : parent;
    const PathGround ground(mesh, {});
    const HullPlaneTree planes(run.hull);
    const BendPool pool(ground, planes, field, ground.order);
    EXPECT_EQ(pool.size(), mesh.vertices.size());
    std::size_t named = 0, looked_at = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); v += 37) {
        std::set<std::int32_t> visited;
        const auto length_m = [&](std::int32_t u) {
            const auto bend = static_cast<std::size_t>(u);
            return (mesh.vertices[bend] - mesh.vertices[v]).norm() + field.value_m[bend];
        };
        double least_m = field.value_m[v];
        pool.visit_promising(v, field.value_m[v], [&](std::int32_t bend) {
            visited.insert(bend);
            least_m = std::min(least_m, length_m(bend));
            return field.value_m[v];
        });
        named += visited.size();
        // A limit that falls with what is found still leads to the shortest.
        double found_m = field.value_m[v];
        pool.visit_promising(v, field.value_m[v], [&](std::int32_t bend) {
            ++looked_at;
            return found_m = std::min(found_m, length_m(bend));
        });
        EXPECT_EQ(found_m, least_m);
        for (std::int32_t u = 0; u < vertices; ++u) {
            const Vector3d way = mesh.vertices[static_cast<std::size_t>(u)] - mesh.vertices[v];
            if (u == static_cast<std::int32_t>(v)) continue;
            const auto bend = static_cast<std::size_t>(u);
            const Vector3d to = way.normalized();
            const std::int32_t next = field.parent[bend];
            const Vector3d onward =
                next >= 0
                    ? Vector3d((mesh.vertices[static_cast<std::size_t>(next)] - mesh.vertices[bend])
                                   .normalized())
                    : run.hull.facets[static_cast<std::size_t>(-1 - next)].normal;
            const Vector3d& normal = ground.normals[bend];
            const double slack = BendPool::kSlack;
            const double room =
                std::min({(field.value_m[v] - way.norm() - field.value_m[bend]) / ground.diagonal_m,
                          to.dot(ground.normals[v]) + double{ground.spread[v]} + slack,
                          double{ground.spread[bend]} + slack - std::abs(to.dot(normal)),
                          (to - onward).dot(normal) + slack});
            if (std::abs(room) > 1e-4) {
                EXPECT_EQ(visited.contains(u), room > 0.0) << v << " " << u;
            }
        }
    }
    EXPECT_GT(named, 100u);
    EXPECT_LT(looked_at, named);
}

// Flat and hollow vertices carry no bend; a convex edge's do. A channel: only where two of its
// outer faces or a wall's rim meet.
TEST(PathGround, BendsAreAtConvexEdgesAlone) {
    const TriangleMesh mesh = test::u_channel(0.05, 0.03, 0.005, 0.2, 3000);
    const PathGround ground(mesh, {});
    std::size_t convex = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vector3d& p = mesh.vertices[v];
        const bool inside = std::abs(p.x()) < 0.015 + 1e-9 && p.z() > -1e-9;
        const bool inner_flat =
            inside && p.z() < 0.05 - 1e-9 && std::abs(p.y()) < 0.1 - 1e-9;  // floor, walls, corners
        if (inner_flat) {
            EXPECT_FALSE(ground.can_bend[v]) << p.transpose();
        }
        const bool rim = inside && p.z() > 0.05 - 1e-9;
        if (rim) {
            EXPECT_TRUE(ground.can_bend[v]) << p.transpose();
        }
        convex += ground.can_bend[v] != 0;
    }
    EXPECT_GT(convex, 50u);
}

// A cube's corner leans as much to each of its three sides, however many triangles meet there: its
// normal is the diagonal, 1 / sqrt(3) from each side's. A ray starts one lift along it, and its
// side's normals are as far off as the sine says: sqrt(2 / 3). The angles are good to 3e-5 rad.
TEST(PathGround, ACornersNormalIsTheMeanOfItsSides) {
    const TriangleMesh mesh = test::box({0.04, 0.04, 0.04}, 12);
    const PathGround ground(mesh, {});
    ASSERT_EQ(mesh.vertices.size(), 8U);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vector3d outward = mesh.vertices[v].normalized();
        EXPECT_LT((ground.normals[v] - outward).norm(), 1e-4) << v;
        EXPECT_NEAR((ground.lifted[v] - mesh.vertices[v]).norm(), ground.offset_m, 1e-12);
        EXPECT_GT((ground.lifted[v] - mesh.vertices[v]).dot(outward), 0.99 * ground.offset_m);
        EXPECT_NEAR(ground.spread[v], std::sqrt(2.0 / 3.0), 1e-4);
    }
    const double area_m2 = 0.5 * 0.04 * 0.04;
    EXPECT_NEAR(ground.offset_m, 2e-5 * 0.04 * std::sqrt(3.0), 1e-12);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle& t = mesh.faces[f];
        const Vector3d& a = mesh.vertices[t[0]];
        const Vector3d cross = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
        EXPECT_LT((ground.corners[f].normal - cross / (2.0 * area_m2)).norm(), 1e-12);
        EXPECT_NEAR(ground.corners[f].angle_rad.sum(), std::numbers::pi, 1e-12);
        EXPECT_NEAR(ground.corners[f].angle_rad.maxCoeff(), 0.5 * std::numbers::pi, 3e-5);
    }
}

}  // namespace
}  // namespace graspd::concavity_detail
