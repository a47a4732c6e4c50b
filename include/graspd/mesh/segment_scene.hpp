#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// How a view of a table comes apart.
struct SegmentSceneConfig {
    double plane_within_m = 0.01;       ///< [m] points nearer to the plane belong to it
    double gap_m = 0.02;                ///< [m] groups farther apart are two objects
    double largest_m = 0.5;             ///< [m] longest side of an object's box; larger: background
    std::uint32_t least_points = 100;   ///< of an object
    std::uint32_t max_points = 100000;  ///< more are thinned, one point a cube of a grid
    std::uint32_t rounds = 1000;        ///< planes that are tried

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("plane_within_m", self.plane_within_m, 1e-4, 0.1);
        visit("gap_m", self.gap_m, 1e-3, 0.5);
        visit("largest_m", self.largest_m, 0.01, 10.0);
        visit("least_points", self.least_points, 10u, 100000u);
        visit("max_points", self.max_points, 1000u, 5000000u);
        visit("rounds", self.rounds, 10u, 100000u);
    }
};

/// A table and what stands on it.
struct SegmentedScene {
    Eigen::Vector3d normal =
        Eigen::Vector3d::UnitZ();        ///< unit, of the plane, to the objects' side
    double offset_m = 0.0;               ///< [m] normal . p = offset on the plane
    std::vector<PointCloud> objects;     ///< [m] the largest first, ties by their lowest point
    std::vector<PointCloud> background;  ///< [m] groups that are too large for an object
};

/// Finds the largest plane of a cloud (RANSAC of PCL with a fixed seed, refined by least squares)
/// and the groups of points on the side of it where the sensor stood, or, without a sensor origin,
/// where most points are. What lies beyond the plane is left out.
///
/// Source: none in the paper, whose objects come alone.
/// @return kInvalidInput for a setting out of range or fewer than 3 finite points; kDegenerate when
///         no plane holds a tenth of the points (with its share), or nothing stands on it
/// Complexity O(rounds x N + N n), n points within gap_m. Same points in the same order, same
/// bytes.
Result<SegmentedScene> segment_scene(const PointCloud& cloud, const SegmentSceneConfig& config);

}  // namespace graspd
