#include "support/exact_surface.hpp"

#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

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
