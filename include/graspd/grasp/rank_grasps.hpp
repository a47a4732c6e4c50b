#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/result.hpp"

namespace graspd {

/// When two grasps are the same for a person.
struct RankGraspsConfig {
    double same_distance_finger_widths = 0.5;  ///< [1] between their TCPs
    double same_angle_rad = 0.26;              ///< [rad] between their frames, about 15 degrees
    double likely_score = 0.5;  ///< from which the best of a concavity is never cut off

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("same_distance_finger_widths", self.same_distance_finger_widths, 0.0, 10.0);
        visit("same_angle_rad", self.same_angle_rad, 0.0, 3.2);
        visit("likely_score", self.likely_score, 0.0, 1.0);
    }
};

/// What ranking needs to know of a grasp.
struct RankedEntry {
    double score = 0.0;
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    double finger_width_m = 0.02;  ///< [m] of its gripper
    std::int32_t concavity = -1;   ///< region it belongs to; -1: none
};

/// The order of grasps, and what fell on the way.
struct Ranking {
    // Indices of entries, best first; every entry is in one of them.
    std::vector<std::size_t> order;       ///< the ranked ones
    std::vector<std::size_t> duplicates;  ///< those that a better one stands for
    std::vector<std::size_t> surplus;     ///< those beyond max_grasps
};

/// Angle of the rotation between two grasps [rad]; a grasp and the same with fingers swapped (half
/// a turn about Gz) are no distance apart.
double grasp_angle_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

/// Ranks by falling score, ties by index, without duplicates.
///
/// Source: Lei & Wisse 2016, Sec. II-F: best candidate per concavity, then the best over all.
/// Deviation: several grasps a concavity may be returned; but the best one of each concavity, if it
/// is likely to hold, is never cut off by max_grasps as long as there are no more concavities than
/// that.
///
/// @return kInvalidInput for a score that is not finite, max_grasps of 0 or a parameter out of
///         range
/// Complexity O(N^2). Pure.
Result<Ranking> rank_grasps(std::span<const RankedEntry> entries, std::uint32_t max_grasps,
                            const RankGraspsConfig& config);

}  // namespace graspd
