#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

/// How tightly the outline follows the points.
struct ConcaveHullConfig {
    /// Radius of the disc that must not pass between neighbours, in spacings: below 2 the outline
    /// shatters, at 5 it fills notches.
    double alpha_spacings = 3.0;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("alpha_spacings", self.alpha_spacings, 1.0, 20.0);
    }
};

/// The outline of a set of points. Every loop runs counter-clockwise, starts at its
/// lexicographically least point and does not repeat its closing vertex.
struct ConcaveHull {
    std::vector<Eigen::Vector2d> outline;  ///< [m] the loop of largest area
    /// [m] holes and further components, by falling area
    std::vector<std::vector<Eigen::Vector2d>> other_loops;
};

/// Finds the concave hull (alpha shape) of points in a plane.
///
/// Source: Lei & Wisse 2016, Sec. II-D, Fig. 7.
/// Deviation: CGAL's Delaunay triangulation instead of PCL's ConcaveHull, which triangulates anew
/// for every radius and takes ten times as long.
/// Deviation: points nearer than a quarter of the spacing to a kept one are dropped first, because
/// a projection stacks front and back of the surface. Deviation: where two parts of the shape meet
/// in a single point an outline would pass that point twice; alpha then grows by 15 % until no
/// point is such a one, 10 times at most (4 times the configured one).
///
/// @param points     (N, N >= 4) points [m], any order, the result does not depend on it
/// @param spacing_m  [m] usual distance of neighbours, > 0
/// @return loops whose vertices are points of the input, unchanged; kInvalidInput for a non-finite
///         point, a spacing or a parameter out of range; kDegenerate for fewer than 4 distinct
///         points, for collinear ones, when the points lie too far apart for any triangle to fit
///         alpha, and when the outline stays pinched
/// Complexity O(N log N). Pure, so safe to call from any thread.
Result<ConcaveHull> concave_hull(std::span<const Eigen::Vector2d> points, double spacing_m,
                                 const ConcaveHullConfig& config);

}  // namespace graspd
