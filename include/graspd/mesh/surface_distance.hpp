#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/box_tree.hpp"
#include "graspd/base/geometry.hpp"

namespace graspd {

/// How far points are from a surface. Immutable after construction, so safe to query from any
/// thread.
class SurfaceDistance {
public:
    /// @param mesh  at least one face, finite [m]; copies what it needs. Cost O(F log F)
    explicit SurfaceDistance(const TriangleMesh& mesh);

    /// Distance [m] from a finite point to the nearest point of any face; `at_most_m` when there is
    /// none nearer. Exact up to the rounding of double precision. Cost O(log F) near the surface.
    double to(const Eigen::Vector3d& point, double at_most_m) const;

private:
    Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< [m]
    double units_per_m_ = 1.0;
    BoxTree tree_;  ///< in units of the diagonal, from the middle
    std::vector<Eigen::Vector3d> vertices_;
    std::vector<Triangle> faces_;  ///< in the order of the leaves
};

/// Distance [m] from a point to a triangle, which may have no area.
double distance_to_triangle_m(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace graspd
