#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

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

    /// Whether a triangle meets any triangle.
    bool meets(const std::array<Eigen::Vector3d, 3>& triangle) const;

    /// Whether the surface of a convex body, or the body itself, meets any triangle; the body is
    /// the hull of its corners.
    bool meets_hull(const std::vector<Eigen::Vector3d>& corners) const;

    /// Whether a point that is on no triangle lies inside the closed surface: by the parity of what
    /// three lines cross, of which one may run through an edge.
    bool contains(const Eigen::Vector3d& point) const;

    /// Triangles that meet a box along the axes, rising.
    std::vector<std::uint32_t> faces_in(const Eigen::AlignedBox3d& box) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// The eight corners of a box in its outer frame.
std::vector<Eigen::Vector3d> corners_of(const OrientedBox& box);

/// Least distance between a solid box that spans [-half, half] and a triangle that does not meet
/// it.
double exact_distance_m(const Eigen::Vector3d& half,
                        const std::array<Eigen::Vector3d, 3>& triangle);

/// Whether any two faces of the mesh meet elsewhere than in a corner or edge that they share.
bool intersects_itself(const TriangleMesh& mesh);

}  // namespace graspd::test
