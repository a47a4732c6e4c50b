#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "support/concavity_answers.hpp"
#include "support/concavity_run.hpp"
#include "support/shapes.hpp"

namespace graspd {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// All triangles of a mesh under exact predicates.
class ExactSurface {
public:
    explicit ExactSurface(const TriangleMesh& mesh) {
        for (const Triangle& face : mesh.faces) {
            triangles_.emplace_back(point(mesh.vertices[face[0]]), point(mesh.vertices[face[1]]),
                                    point(mesh.vertices[face[2]]));
        }
        tree_.rebuild(triangles_.begin(), triangles_.end());
    }
    bool blocks(const Vector3d& a, const Vector3d& b) const {
        return tree_.do_intersect(Kernel::Segment_3(point(a), point(b)));
    }

private:
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;

    static Kernel::Point_3 point(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

    Triangles triangles_;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

/// Where ways run: the vertices lifted off the surface along the mean of their faces' normals,
/// weighted by angle. Worked out here anew.
std::vector<Vector3d> lifted(const TriangleMesh& mesh, double by_m) {
    std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
    for (const Triangle& face : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d a = mesh.vertices[face[(k + 1) % 3]] - mesh.vertices[face[k]];
            const Vector3d b = mesh.vertices[face[(k + 2) % 3]] - mesh.vertices[face[k]];
            const double angle = std::acos(a.normalized().dot(b.normalized()));
            normals[face[k]] += angle * a.cross(b).normalized();
        }
    }
    std::vector<Vector3d> points = mesh.vertices;
    for (std::size_t v = 0; v < points.size(); ++v) points[v] += by_m * normals[v].normalized();
    return points;
}

struct Tally {
    std::size_t segments = 0, blocked = 0, wrong_lengths = 0, wrong_ends = 0;
};

/// Walks every vertex's way by its parents and by escape_path, and tests each first segment (the
/// later ones are some bend's own first). The last one ends a lift short of the hull's plane, as
/// the object's own sides may lie in that.
Tally check_ways(const TriangleMesh& mesh, const test::ConcavityRun& run) {
    const ConcavityConfig config;
    const double lift_m = config.start_offset * mesh_diagonal_m(mesh);
    const std::vector<Vector3d> start = lifted(mesh, lift_m);
    const ExactSurface surface(mesh);
    Tally tally;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const double value_m = run.field.value_m[v];
        if (!std::isfinite(value_m) || value_m < 2.0 * lift_m) continue;
        const std::int32_t parent = run.field.parent[v];
        Vector3d end;
        if (parent >= 0) {
            end = start[static_cast<std::size_t>(parent)];
        } else {
            const HullFacet& facet = run.hull.facets[static_cast<std::size_t>(-1 - parent)];
            const double gap_m = facet.offset_m - facet.normal.dot(start[v]) - lift_m;
            end = start[v] + std::max(0.0, gap_m) * facet.normal;
        }
        ++tally.segments;
        tally.blocked += surface.blocks(start[v], end);
        const auto path = escape_path(mesh, run.hull, run.field, v);
        double length_m = 0.0;
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
            length_m += (path[i + 1] - path[i]).norm();
        tally.wrong_lengths += !(std::abs(length_m - value_m) < 1e-9 * value_m);
        double outside_m = -1.0;  // the end lies on the hull's surface or a little outside it
        for (const HullFacet& facet : run.hull.facets) {
            outside_m = std::max(outside_m, facet.normal.dot(path.back()) - facet.offset_m);
        }
        tally.wrong_ends += path.front() != mesh.vertices[v] || outside_m < -1e-9 * value_m;
    }
    return tally;
}

// Every value above the lift is the length of a way that exact predicates find free; none of it is
// the program's own ray test. The ways end on the hull.
TEST(EscapePath, NoSegmentIsBlocked) {
    std::size_t segments = 0;
    for (const std::size_t faces : {1000u, 5000u}) {
        auto answers = test::straight_answers(faces);
        for (auto& bent : test::bent_answers(faces)) answers.push_back(std::move(bent));
        for (const test::ConcavityAnswer& answer : answers) {
            SCOPED_TRACE(answer.name + " of " + std::to_string(faces));
            const TriangleMesh mesh = test::moved(answer.mesh, test::random_pose(faces));
            const Tally tally = check_ways(mesh, test::run_concavity(mesh));
            EXPECT_EQ(tally.blocked, 0u);
            EXPECT_EQ(tally.wrong_lengths, 0u);
            EXPECT_EQ(tally.wrong_ends, 0u);
            segments += tally.segments;
        }
    }
    EXPECT_GT(segments, 10000u);
}

TEST(EscapePath, NoSegmentIsBlockedInALargeMesh) {
    for (const test::ConcavityAnswer& answer : test::bent_answers(70000)) {
        SCOPED_TRACE(answer.name);
        const TriangleMesh mesh = test::moved(answer.mesh, test::random_pose(7));
        const Tally tally = check_ways(mesh, test::run_concavity(mesh));
        EXPECT_EQ(tally.blocked, 0u);
        EXPECT_EQ(tally.wrong_lengths, 0u);
        EXPECT_GT(tally.segments, 10000u);
    }
}

// From beneath the lid of an undercut channel: the vertex, the slot's lower edge, straight up to
// the hull's top. Worked by hand.
TEST(EscapePath, NamesTheBends) {
    const test::ConcavityAnswer channel = test::bent_answers(3000)[0];
    const test::ConcavityRun run = test::run_concavity(channel.mesh);
    int checked = 0;
    for (std::uint32_t v = 0; v < channel.mesh.vertices.size(); ++v) {
        const Vector3d& p = channel.mesh.vertices[v];
        const bool in_corner = std::abs(p.x() - 0.04) < 1e-9 && std::abs(p.z()) < 1e-9;
        if (!in_corner || std::abs(p.y()) > 0.09) continue;
        ++checked;
        const auto path = escape_path(channel.mesh, run.hull, run.field, v);
        ASSERT_EQ(path.size(), 3u);
        EXPECT_EQ(path[0], p);
        EXPECT_LT((path[1] - Vector3d(0.01, p.y(), 0.03)).norm(), 1e-9);
        EXPECT_LT((path[2] - Vector3d(0.01, p.y(), 0.036)).norm(), 1e-9);
    }
    EXPECT_GT(checked, 5);
}

}  // namespace
}  // namespace graspd
