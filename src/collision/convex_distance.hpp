#pragma once

#include <span>

#include <Eigen/Core>

namespace graspd::collision_detail {

/// Least distance between the hulls of two sets of points in the same frame, 0 where they meet.
///
/// Source: Gilbert, Johnson, Keerthi 1988; the least point of a simplex after Ericson, Real-Time
/// Collision Detection, 5.1. Ends when the lower bound that a support point proves is within 1e-9
/// m.
/// @param most_m  [m] > 0: a greater distance is reported as most_m, which is cheaper
double distance_m(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b,
                  double most_m);

}  // namespace graspd::collision_detail
