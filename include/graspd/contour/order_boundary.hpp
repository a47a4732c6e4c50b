#pragma once

#include <vector>

#include <Eigen/Core>

namespace graspd {

/// Puts boundary points in a row: from x_min to the nearest unused point each time.
///
/// Source: Lei & Wisse 2016, Sec. II-E, Fig. 12a. Several pieces of boundary come out one after the
/// other; where one ends, the row jumps.
///
/// @param points  (N) finite points [m], any order, the result does not depend on it
/// @return the same points; the first has the least x (ties: the least y), each next one is the
///         nearest of the rest (ties: the lexicographically least)
/// Complexity O(N^2). Pure, so safe to call from any thread.
std::vector<Eigen::Vector2d> order_boundary(std::vector<Eigen::Vector2d> points);

}  // namespace graspd
