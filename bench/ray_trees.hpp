#pragma once

#include <memory>

#include "graspd/base/geometry.hpp"

namespace graspd::bench {

/// A tree over a mesh's triangles that tells free segments from blocked ones.
class RayTree {
public:
    virtual ~RayTree() = default;
    /// Whether a triangle meets the segment from `a` to `b` [m].
    virtual bool blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const = 0;
};
using RayTreePtr = std::unique_ptr<RayTree>;

/// Triangles without an area are left out of every tree.
inline bool has_area(const TriangleMesh& mesh, const Triangle& face) {
    const Eigen::Vector3d& a = mesh.vertices[face[0]];
    return (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a).squaredNorm() > 0.0;
}

/// CGAL's AABB tree with exact predicates.
RayTreePtr cgal_tree(const TriangleMesh& mesh);

/// FCL's BVHModel of OBBRSS. It knows no segments: against a capsule of this radius [m], or against
/// a model of one triangle without width.
RayTreePtr fcl_capsule_tree(const TriangleMesh& mesh, double radius_m);
RayTreePtr fcl_triangle_tree(const TriangleMesh& mesh);

/// Embree 3 in single precision: as it comes; with its flag for watertight edges; with that flag
/// and no wider instructions than those that our tree is compiled for.
RayTreePtr embree_fast_tree(const TriangleMesh& mesh);
RayTreePtr embree_robust_tree(const TriangleMesh& mesh);
RayTreePtr embree_sse42_tree(const TriangleMesh& mesh);

}  // namespace graspd::bench
