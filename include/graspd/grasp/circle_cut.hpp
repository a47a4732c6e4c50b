#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace graspd {

/// Where a circle cuts a polyline.
struct CircleCut {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [m]
    std::size_t segment = 0;                          ///< n: the point lies on [n, n+1]
};

/// The first segment of a polyline that a circle cuts, and the cut.
///
/// Source: Lei & Wisse 2016, Sec. II-E, eqs. (2)-(3): segment [n, n+1] is cut when
/// d_n <= r <= d_{n+1} or d_n >= r >= d_{n+1}, d_k the distance from the centre to point k. As in
/// the paper a segment that enters the circle and leaves it again is not seen; boundary points lie
/// far closer than any radius in use.
/// Deviation: segments longer than `max_gap_m` are jumps of the nearest-neighbour order, not
/// boundary: no cut there.
///
/// @param polyline      (N) finite points [m]
/// @param center        [m] same plane, finite
/// @param radius_m      [m] > 0
/// @param from_segment  segments before this one are not looked at
/// @param max_gap_m     [m] > 0, may be infinite
/// @return the cut in the direction of the polyline, none when there is none
/// Complexity O(N). Pure, so safe to call from any thread.
std::optional<CircleCut> first_circle_cut(std::span<const Eigen::Vector2d> polyline,
                                          const Eigen::Vector2d& center, double radius_m,
                                          std::size_t from_segment, double max_gap_m);

/// Every cut, in the order of the polyline; parameters as in first_circle_cut. A vertex that lies
/// exactly on the circle counts once.
std::vector<CircleCut> all_circle_cuts(std::span<const Eigen::Vector2d> polyline,
                                       const Eigen::Vector2d& center, double radius_m,
                                       std::size_t from_segment, double max_gap_m);

}  // namespace graspd
