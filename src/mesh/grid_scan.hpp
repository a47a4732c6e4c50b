#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"

namespace graspd::mesh_detail {

/// A face ready to be scanned. Its corners stand in lexicographic order, so that rounding does not
/// depend on where the face began.
struct ScanFace {
    std::array<Eigen::Vector3d, 3> corner;
    std::array<double, 3> value_m{};
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit; zero for a face without area
    double area_m2 = 0.0;
    int axis = 2;  ///< dominant
};

/// Whether a point comes before another one in lexicographic order.
bool precedes(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// @param value_m  one per vertex; the faces' indices fit both
std::vector<ScanFace> faces_to_scan(const TriangleMesh& mesh, std::span<const double> value_m);

/// Rows of the grid that the face spans, at most.
double rows_of(const ScanFace& face, double spacing_m);

/// Samples where the lines of the grid meet faces, in the order of the faces.
std::vector<SurfaceSample> scan_faces(std::span<const ScanFace> faces, double spacing_m);

}  // namespace graspd::mesh_detail
