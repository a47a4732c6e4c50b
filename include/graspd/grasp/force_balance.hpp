#pragma once

#include <span>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

/// How well two parallel jaws can squeeze one grasp candidate.
///
/// Source: Lei & Wisse 2016, Sec. II-F, eq. (4), Figs. 18-20.
/// Deviation: lines are fitted by total least squares, because eq. (4), v = kx + b,
/// has no finite k for a side perpendicular to the closing axis Gx - the ideal grasp.
struct ForceBalanceConfig {
    double max_rms_m = 0.005;  ///< [m] a side rougher than this is not a line

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("max_rms_m", self.max_rms_m, 1e-6, 0.1);
    }
};

/// The two fitted lines against each other. A lean is the angle of a side's line from the axis Gy,
/// positive when the side moves outward, away from the other one, with growing y. So a wedge has
/// two leans of the same sign, a parallelogram opposite ones.
struct ForceBalance {
    double beta_rad = 0.0;        ///< [rad] angle between the two sides, in [0, pi); 0 is best
    double rms_m = 0.0;           ///< [m] the worse of the two line fits
    double lean_left_rad = 0.0;   ///< [rad] alpha_L in [-pi/2, pi/2)
    double lean_right_rad = 0.0;  ///< [rad] alpha_R in (-pi/2, pi/2]; beta = |alpha_L + alpha_R|
};

/// Fits a line to each grasp side and measures the angle between them.
///
/// Beta alone accepts nothing: two parallel sides that both lean 45 degrees have beta 0 and need a
/// friction of 1. See min_friction().
///
/// @param left_G   (N, N >= 2) points of the side at -Gx [m], in the XOY plane of frame G
/// @param right_G  (M, M >= 2) points of the side at +Gx [m], same plane and frame
/// @return the balance; kInvalidInput for fewer than 2 points, a non-finite one or a parameter out
///         of range, kDegenerate when a side's points coincide, spread alike in every direction,
///         or their fit exceeds max_rms_m
/// Complexity O(N + M). Pure, so safe to call from any thread.
Result<ForceBalance> evaluate_force_balance(std::span<const Eigen::Vector2d> left_G,
                                            std::span<const Eigen::Vector2d> right_G,
                                            const ForceBalanceConfig& config);

/// The least Coulomb friction coefficient with which two point contacts hold without slipping: tan
/// of the largest angle between the line that joins them and each inward normal.
///
/// Source: not in the paper, which ranks by beta alone; Nguyen's two-contact condition.
///
/// @param contact_left_G          [m] frame G, or any other that all four share
/// @param outward_normal_left_G   any length > 0, out of the object
/// @param contact_right_G         [m] same frame
/// @param outward_normal_right_G  any length > 0, out of the object
/// @return the coefficient, >= 0; +infinity at 90 degrees or more, and when a direction is missing
///         because the contacts coincide or a normal is zero or not finite
/// Complexity O(1). Pure, so safe to call from any thread.
double min_friction(const Eigen::Vector3d& contact_left_G,
                    const Eigen::Vector3d& outward_normal_left_G,
                    const Eigen::Vector3d& contact_right_G,
                    const Eigen::Vector3d& outward_normal_right_G);

}  // namespace graspd
