#pragma once

#include <cstdint>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// How a point cloud becomes a surface.
struct TriangulateCloudConfig {
    bool greedy_projection = false;        ///< true: PCL's greedy projection, the paper's "fast
                                           ///< triangulation"; false: CGAL's advancing front, which
                                           ///< passes through the points and leaves fewer holes
    std::uint32_t max_points = 20000;      ///< more are thinned, one point a cube of a grid
    std::uint32_t limit_points = 5000000;  ///< more are refused
    std::uint32_t normal_neighbours = 16;  ///< of the normal estimate (greedy projection)
    double radius_spacings = 5.0;          ///< [1] greedy search radius in median point spacings
    double mu = 2.5;                   ///< [1] greedy: neighbour distance over the nearest one's
    double outlier_spacings = 5.0;     ///< [1] groups of points farther apart than so many median
                                       ///< spacings; 0: nothing is an outlier
    std::uint32_t outlier_group = 10;  ///< a group with fewer points is dropped

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("greedy_projection", self.greedy_projection);
        visit("max_points", self.max_points, 10u, 5000000u);
        visit("limit_points", self.limit_points, 10u, 50000000u);
        visit("normal_neighbours", self.normal_neighbours, 3u, 200u);
        visit("radius_spacings", self.radius_spacings, 1.0, 100.0);
        visit("mu", self.mu, 1.0, 10.0);
        visit("outlier_spacings", self.outlier_spacings, 0.0, 1000.0);
        visit("outlier_group", self.outlier_group, 1u, 1000u);
    }
};

/// A surface made of a cloud's points.
struct TriangulatedCloud {
    TriangleMesh mesh;  ///< [m] same frame; may be open and inconsistently wound: feed
                        ///< it to condition_mesh
    std::vector<std::int32_t> vertex_of_point;  ///< per input point: the mesh vertex that stands
                                                ///< for it, or -1 (dropped)
    double spacing_m = 0.0;                     ///< [m] median distance to the nearest neighbour
    /// points_not_finite, points_duplicate, points_thinned, outliers_removed, points_unused (in no
    /// triangle), and always surface_deviation: the greatest distance [m] of the points, outliers
    /// aside, from the mesh
    std::vector<Finding> findings;
};

/// Triangulates a point cloud.
///
/// Source: Lei & Wisse 2016, Sec. II-A, Fig. 3a-b.
/// Deviation: advancing front by default; greedy projection leaves 7 to 90 holes on the two
/// multi-view clouds that we measured.
/// @param cloud  points [m]; NaN and infinite ones are dropped with a finding. Their order changes
///               nothing: the vertices are those that are kept, in lexicographic order
/// @return kInvalidInput for an empty cloud or fewer than 10 finite distinct points (count in
///         detail); kTooLarge above limit_points; kDegenerate when the points are coplanar or
///         collinear, or no triangle came out
/// Pure; the result does not depend on threads.
Result<TriangulatedCloud> triangulate_cloud(const PointCloud& cloud,
                                            const TriangulateCloudConfig& config);

}  // namespace graspd
