#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

/// From which lengths of gripper and sampling the step and the longest gap are derived.
struct StepPointsConfig {
    double step_finger_widths = 0.5;  ///< step r in finger widths (the paper leaves it open)
    double max_gap_spacings = 4.0;    ///< longer segments are jumps; in spacings

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("step_finger_widths", self.step_finger_widths, 0.01, 10.0);
        visit("max_gap_spacings", self.max_gap_spacings, 1.0, 100.0);
    }
};

/// A place on the boundary where a grasp candidate begins.
struct StepPoint {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [m]
    std::size_t segment = 0;                          ///< the boundary segment it lies on
};

/// Walks along the ordered boundary with equal chords.
///
/// Source: Lei & Wisse 2016, Sec. II-E, eqs. (2)-(3), Figs. 12b-13: the first step point is the
/// first boundary point; the circle of radius r about the current one gives the next one on the
/// first segment that it cuts; the points passed are dropped; go on while d_max, the largest
/// distance from the current step point to the remaining boundary points, exceeds the hand's width.
/// Deviation: segments longer than `max_gap_m` are jumps of the nearest-neighbour order. Where one
/// comes before the next cut, the walk goes on at the first point behind it, so that every piece of
/// the boundary is walked; the step across is then no chord of length r.
///
/// @param boundary      (N, N >= 2) points [m] as order_boundary leaves them
/// @param step_m        [m] r > 0
/// @param hand_width_m  [m] > 0
/// @param max_gap_m     [m] > 0, may be infinite
/// @return the step points in boundary order, at least one; the last boundary point, when reached
///         by a jump, reports segment N - 2; kInvalidInput for a non-finite point or a length out
///         of range, kDegenerate for fewer than 2 points, kTooLarge when the boundary is longer
///         than 100000 steps
/// Complexity O(N S) for S step points. Pure, so safe to call from any thread.
Result<std::vector<StepPoint>> step_points(std::span<const Eigen::Vector2d> boundary, double step_m,
                                           double hand_width_m, double max_gap_m);

}  // namespace graspd
