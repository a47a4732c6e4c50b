#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fast_marching.hpp"
#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "split_surface.hpp"
#include "work_limits.hpp"

namespace graspd::concavity_detail {

/// The free space outside an object that is joined to the outside of its hull.
struct Gap {
    Tetrahedra space;                          ///< points as given, then the splits'
    std::vector<std::uint32_t> node_of_point;  ///< the point of `space` that stands for each one:
                                               ///< itself, or another one in the same place
};

/// Delaunay tetrahedra of a surface's points and others, those outside the surface kept.
///
/// The surface's pieces that are no faces of tetrahedra are split until all are (a plain Delaunay
/// tetrahedralisation does not keep given faces). Then the outside is what can be reached from
/// infinity without crossing a piece; nothing is decided by a tolerance.
/// @param surface  pieces between the points, closed and outward oriented
/// @param points   of the surface and in the gap, about 1 in extent
/// @return kDegenerate when pieces are still missing after the last round; kInvalidInput when a
///         piece's back is reached; kTooLarge by the limits; kInternal when CGAL fails
Result<Gap> fill_gap(SplitSurface surface, std::vector<Eigen::Vector3d> points,
                     const WorkLimits& limits);

}  // namespace graspd::concavity_detail
