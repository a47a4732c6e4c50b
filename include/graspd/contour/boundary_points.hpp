#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

/// How near the object's boundary a point of the cluster's outline must lie.
struct BoundaryPointsConfig {
    double d_threshold_spacings = 1.0;  ///< d_threshold in spacings (the paper leaves it open)

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("d_threshold_spacings", self.d_threshold_spacings, 1e-3, 20.0);
    }
};

/// Keeps the points of a cluster's outline that lie on the object's boundary, not inside it.
///
/// Source: Lei & Wisse 2016, Sec. II-D, eq. (1), Figs. 10-11: for each point n the perpendicular on
/// each segment [m, m+1] of the enlarged outline; the foot F = m + t (m+1 - m) counts only if
/// 0 <= t <= 1; n is a boundary point iff the least |nF| is below d_threshold.
///
/// @param cluster_outline   (N, N >= 3) closed loop [m], closing vertex not repeated
/// @param enlarged_outline  (M, M >= 3) closed loop [m] of the enlarged set, same plane
/// @param spacing_m         [m] usual distance of neighbours, > 0
/// @return the boundary points in the order of `cluster_outline`, none when it runs wholly inside;
///         kInvalidInput for a non-finite point, a spacing or a parameter out of range;
///         kDegenerate for a loop of fewer than 3 points
/// Complexity O(N M). Pure, so safe to call from any thread.
Result<std::vector<Eigen::Vector2d>> boundary_points(
    std::span<const Eigen::Vector2d> cluster_outline,
    std::span<const Eigen::Vector2d> enlarged_outline, double spacing_m,
    const BoundaryPointsConfig& config);

}  // namespace graspd
