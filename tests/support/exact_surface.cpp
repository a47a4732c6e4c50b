#include "support/exact_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

namespace graspd::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Kernel::Point_3 point(const Eigen::Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

}  // namespace

struct ExactSurface::Tree {
    Triangles triangles;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> boxes;
};

ExactSurface::ExactSurface(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
    for (const Triangle& face : mesh.faces) {
        tree_->triangles.emplace_back(point(mesh.vertices[face[0]]), point(mesh.vertices[face[1]]),
                                      point(mesh.vertices[face[2]]));
    }
    tree_->boxes.rebuild(tree_->triangles.cbegin(), tree_->triangles.cend());
}

ExactSurface::~ExactSurface() = default;
ExactSurface::ExactSurface(ExactSurface&&) noexcept = default;
ExactSurface& ExactSurface::operator=(ExactSurface&&) noexcept = default;

bool ExactSurface::blocks(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return tree_->boxes.do_intersect(Kernel::Segment_3(point(a), point(b)));
}

bool ExactSurface::meets(const std::array<Eigen::Vector3d, 3>& t) const {
    return tree_->boxes.do_intersect(Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2])));
}

bool ExactSurface::meets_hull(const std::vector<Eigen::Vector3d>& corners) const {
    std::vector<Kernel::Point_3> points;
    for (const Eigen::Vector3d& corner : corners) points.push_back(point(corner));
    CGAL::Surface_mesh<Kernel::Point_3> hull;
    CGAL::convex_hull_3(points.begin(), points.end(), hull);
    bool holds = true;  // the first corner of the first triangle: the whole body may lie in there
    for (const auto face : hull.faces()) {
        const auto half_edge = hull.halfedge(face);
        const Kernel::Triangle_3 triangle(hull.point(hull.source(half_edge)),
                                          hull.point(hull.target(half_edge)),
                                          hull.point(hull.target(hull.next(half_edge))));
        if (tree_->boxes.do_intersect(triangle)) return true;
        holds = holds && CGAL::orientation(triangle[0], triangle[1], triangle[2],
                                           tree_->triangles.front()[0]) == CGAL::NEGATIVE;
    }
    return holds;
}

bool ExactSurface::contains(const Eigen::Vector3d& p) const {
    const Kernel::Vector_3 directions[] = {
        {0.311, 0.745, 0.589}, {-0.678, 0.213, 0.703}, {0.517, -0.611, -0.599}};
    int inside = 0;
    for (const Kernel::Vector_3& direction : directions) {
        const Kernel::Ray_3 ray(point(p), direction);
        inside += tree_->boxes.number_of_intersected_primitives(ray) % 2 == 1;
    }
    return inside >= 2;
}

std::vector<std::uint32_t> ExactSurface::faces_in(const Eigen::AlignedBox3d& box) const {
    std::vector<Triangles::const_iterator> found;
    tree_->boxes.all_intersected_primitives(
        Kernel::Iso_cuboid_3(point(box.min()), point(box.max())), std::back_inserter(found));
    std::vector<std::uint32_t> faces;
    for (const auto& triangle : found) {
        faces.push_back(static_cast<std::uint32_t>(triangle - tree_->triangles.cbegin()));
    }
    std::ranges::sort(faces);
    return faces;
}

std::vector<Eigen::Vector3d> corners_of(const OrientedBox& box) {
    std::vector<Eigen::Vector3d> corners;
    for (int k = 0; k < 8; ++k) {
        const Eigen::Vector3d side((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1,
                                   (k & 4) != 0 ? 1 : -1);
        corners.push_back(box.pose * side.cwiseProduct(box.half_extent));
    }
    return corners;
}

double exact_distance_m(const Eigen::Vector3d& half,
                        const std::array<Eigen::Vector3d, 3>& triangle) {
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : triangle) {
        least = std::min(least, (p.cwiseAbs() - half).cwiseMax(0.0).squaredNorm());
    }
    OrientedBox box;
    box.half_extent = half;
    const auto corners = corners_of(box);
    const Kernel::Triangle_3 face(point(triangle[0]), point(triangle[1]), point(triangle[2]));
    for (std::size_t k = 0; k < 8; ++k) {
        least = std::min(least, CGAL::squared_distance(point(corners[k]), face));
        for (const std::size_t bit : {1u, 2u, 4u}) {
            if ((k & bit) != 0) continue;
            const Kernel::Segment_3 edge(point(corners[k]), point(corners[k | bit]));
            for (std::size_t i = 0; i < 3; ++i) {
                const Kernel::Segment_3 side(point(triangle[i]), point(triangle[(i + 1) % 3]));
                least = std::min(least, CGAL::squared_distance(edge, side));
            }
        }
    }
    return std::sqrt(least);
}

bool intersects_itself(const TriangleMesh& mesh) {
    namespace processing = CGAL::Polygon_mesh_processing;
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    for (const Eigen::Vector3d& vertex : mesh.vertices) points.push_back(point(vertex));
    for (const Triangle& face : mesh.faces) faces.push_back({face[0], face[1], face[2]});
    processing::orient_polygon_soup(points, faces);  // doubles what is not a manifold
    CGAL::Surface_mesh<Kernel::Point_3> surface;
    processing::polygon_soup_to_polygon_mesh(points, faces, surface);
    return processing::does_self_intersect(surface);
}

}  // namespace graspd::test
