#pragma once

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"

namespace graspd::simulate_detail {

/// A solid of uniform density and unit mass.
struct Solid {
    double volume_m3 = 0.0;                                    ///< [m^3] negative when inside out
    Eigen::Vector3d center = Eigen::Vector3d::Zero();          ///< [m] of mass
    Eigen::Matrix3d inertia_m2 = Eigen::Matrix3d::Identity();  ///< [m^2] about the centre, per kg
};

/// Exact integrals over a closed mesh; each face spans a tetrahedron with the bounding box's
/// middle, because far from it digits would be lost. Without volume centre and inertia are zero.
Solid solid_of(const TriangleMesh& mesh);

}  // namespace graspd::simulate_detail
