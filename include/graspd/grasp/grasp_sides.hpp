#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

/// What counts as a side that a pad can touch.
struct GraspSidesConfig {
    double bin_spacings = 1.0;     ///< width of a bin along Gy, in spacings
    std::uint32_t min_points = 3;  ///< a side with fewer points is none
    double max_depth_m = 0.004;    ///< [m] how far behind its first touch a pad still feels a side

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("bin_spacings", self.bin_spacings, 0.1, 20.0);
        visit("min_points", self.min_points, 2U, 1000U);
        visit("max_depth_m", self.max_depth_m, 1e-4, 1.0);
    }
};

/// The two sides that the fingers will touch, in the XOY plane of G: x closing, y pad width. Each
/// by rising y, at most one point a bin.
struct GraspSides {
    std::vector<Eigen::Vector2d> left_G;   ///< [m] seen first by the pad that comes from -Gx
    std::vector<Eigen::Vector2d> right_G;  ///< [m] seen first by the pad that comes from +Gx
};

/// Finds the parts of a candidate's local cloud that each pad meets first.
///
/// Source: Lei & Wisse 2016, Sec. II-F, Figs. 18-19a.
/// Deviation: no concave hull; per bin of y the least x is the left side and the greatest x the
/// right side, which is what a pad coming along x sees of any hull. Points deeper than
/// `max_depth_m` behind the side's first touch are dropped: a pad cannot reach them.
///
/// @param local_G    (N) points [m] of the local cloud in the XOY plane of G, any order, the result
///                   does not depend on it
/// @param spacing_m  [m] usual distance of neighbours, > 0
/// @return the sides; kInvalidInput for a non-finite point, a spacing or a parameter out of range;
///         kDegenerate when a side has fewer than min_points
/// Complexity O(N log N). Pure, so safe to call from any thread.
Result<GraspSides> grasp_sides(std::span<const Eigen::Vector2d> local_G, double spacing_m,
                               const GraspSidesConfig& config);

}  // namespace graspd
