#pragma once

#include <memory>

#include "graspd/base/geometry.hpp"

namespace graspd::test {

/// All triangles of a mesh under CGAL's exact predicates.
class ExactSurface {
public:
    explicit ExactSurface(const TriangleMesh& mesh);
    ~ExactSurface();
    ExactSurface(ExactSurface&&) noexcept;
    ExactSurface& operator=(ExactSurface&&) noexcept;

    /// Whether the closed segment meets any triangle.
    bool blocks(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// Whether any two faces of the mesh meet elsewhere than in a corner or edge that they share.
bool intersects_itself(const TriangleMesh& mesh);

}  // namespace graspd::test
