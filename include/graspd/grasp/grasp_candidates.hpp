#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/result.hpp"
#include "graspd/grasp/step_points.hpp"

namespace graspd {

/// Which hand widths are tried.
struct GraspCandidatesConfig {
    std::uint32_t widths = 4;    ///< circles of radius opening k / widths, k = 1 .. widths
    bool tangent_widths = true;  ///< besides, the widths at which the circle touches the boundary

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("widths", self.widths, 1u, 100u);
        visit("tangent_widths", self.tangent_widths);
    }
};

/// Two places on the boundary between which the hand closes.
struct GraspCandidate {
    Eigen::Vector2d left_W = Eigen::Vector2d::Zero();   ///< P, the step point [m]
    Eigen::Vector2d right_W = Eigen::Vector2d::Zero();  ///< Q [m]; Gx runs from P to Q
    std::size_t step = 0;                               ///< index of the step point
};

/// Pairs each step point with the places of the boundary that lie a hand's width away.
///
/// Source: Lei & Wisse 2016, Sec. II-E, Figs. 14-16: the circle of radius = hand width about the
/// step point P cuts the boundary in Q, and P-Q is a candidate.
/// Deviation: the hand width is open in the paper. Ours: fixed parts of the opening, and the widths
/// at which the circle just touches the boundary: there P-Q is the shortest way across and stands
/// at right angles to the boundary at Q.
///
/// @param boundary   (N, N >= 2) ordered boundary [m]
/// @param steps      step points on it
/// @param opening_m  [m] > 0, the gripper's greatest opening
/// @param max_gap_m  [m] > 0: longer segments are no boundary
/// @return candidates in the order of the step points, widths rising, at most the opening wide and
///         at least max_gap_m or a quarter of the smallest fixed width, whichever is less;
///         kInvalidInput for a non-finite point, a length or parameter out of range
/// Complexity O(S W N). Pure, so safe to call from any thread.
Result<std::vector<GraspCandidate>> grasp_candidates(std::span<const Eigen::Vector2d> boundary,
                                                     std::span<const StepPoint> steps,
                                                     double opening_m, double max_gap_m,
                                                     const GraspCandidatesConfig& config);

}  // namespace graspd
