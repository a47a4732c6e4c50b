#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "ray_trees.hpp"

namespace graspd::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& point) {
    return {point.x(), point.y(), point.z()};
}

class CgalTree final : public RayTree {
public:
    explicit CgalTree(const TriangleMesh& mesh) {
        triangles_.reserve(mesh.faces.size());
        for (const Triangle& face : mesh.faces) {
            if (!has_area(mesh, face)) continue;
            triangles_.emplace_back(to_cgal(mesh.vertices[face[0]]),
                                    to_cgal(mesh.vertices[face[1]]),
                                    to_cgal(mesh.vertices[face[2]]));
        }
        tree_.insert(triangles_.cbegin(), triangles_.cend());
        tree_.build();
    }
    bool blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const override {
        return tree_.do_intersect(Kernel::Segment_3(to_cgal(a), to_cgal(b)));
    }

private:
    Triangles triangles_;
    Tree tree_;
};

}  // namespace

RayTreePtr cgal_tree(const TriangleMesh& mesh) {
    return std::make_unique<CgalTree>(mesh);
}

}  // namespace graspd::bench
