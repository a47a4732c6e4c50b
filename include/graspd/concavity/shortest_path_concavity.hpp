#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"
#include "graspd/concavity/outer_hull.hpp"

namespace graspd {

/// Tolerances of the any-angle method.
struct ConcavityConfig {
    double start_offset = 2e-5;       ///< [1] of the diagonal: how far off the surface paths run
    double min_gain = 1e-9;           ///< [1] relative gain below which no ray is cast
    std::uint32_t failed_memory = 6;  ///< last parents per vertex that were found hidden
    std::uint32_t max_relaxations_per_vertex = 200;  ///< bounds the propagation
    bool across_the_void = true;  ///< step 3; without it, ways follow the mesh's edges
    bool slide = true;            ///< step 4; without it, ways bend at vertices alone

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("start_offset", self.start_offset, 1e-7, 1e-2);
        visit("min_gain", self.min_gain, 0.0, 1e-3);
        visit("failed_memory", self.failed_memory, 0u, 64u);
        visit("max_relaxations_per_vertex", self.max_relaxations_per_vertex, 1u, 10000u);
        visit("across_the_void", self.across_the_void);
        visit("slide", self.slide);
    }
};

/// Ray tolerance that goes with a start offset: absolute per triangle and 20 times smaller, so that
/// neither a ray leaks between neighbours nor a start point counts as blocked by its own faces.
constexpr double kOffsetOverRayTolerance = 20.0;

/// What a vertex's value is worth.
enum class ConcavityFlag : std::uint8_t {
    kExact,         ///< the straight way to the nearest hull plane is free: no path is shorter
    kPath,          ///< length of an explicit free polyline: an upper bound
    kEnclosed,      ///< no way out was found; the value is +infinity, never 0
    kUnreferenced,  ///< no face uses the vertex; the value is NaN
};
/// "exact", "path", "enclosed", "unreferenced".
const char* to_string(ConcavityFlag flag);

/// A bend of a way out that lies within a mesh edge, or the place where a way that leaves the hull
/// aslant meets its plane.
struct EdgeBend {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< [m] on the edge or the plane
    Eigen::Vector3d lifted = Eigen::Vector3d::Zero();  ///< [m] where rays pass, off the surface
    std::int32_t parent = 0;                           ///< what comes next, as a vertex's
};

/// Concavity of every vertex with the way that proves it.
struct ConcavityField {
    static constexpr std::int32_t kNoParent = INT32_MIN;

    std::vector<double> value_m;  ///< [m] >= 0, +inf (enclosed) or NaN (unreferenced)
    std::vector<ConcavityFlag> flag;
    /// What comes next on the way out. For V vertices: 0 <= p < V the bend at vertex p; p >= V the
    /// bend edge_bends[p - V]; -1 - f the hull's facet f, straight; kNoParent where there is no
    /// way.
    std::vector<std::int32_t> parent;
    std::vector<EdgeBend> edge_bends;
    std::vector<Eigen::Vector3d> lifted;  ///< [m] the vertices, where rays start: off the surface
    double largest_m = 0.0;               ///< [m] greatest finite value
};

/// Times of the steps, for benches [ms].
struct StepTime {
    const char* step;
    double ms = 0.0;
};

/// The vertices' shortest-path concavity: length of the shortest path outside the object from the
/// vertex to its convex hull.
///
/// Source: Lei & Wisse 2016, Sec. II-A, Fig. 3d-f; the measure is that of Zimmer, Campen, Kobbelt
/// (CVPR 2013).
/// Deviation: the paper fills the free space with constrained Delaunay tetrahedra and marches a
/// front through them (seconds, up to 18 % off). Here: (1) distance to the nearest hull plane, a
/// lower bound that one free ray proves exact; (2) any-angle propagation over the mesh's vertices
/// for the rest, every segment ray-tested, strings pulled tight; (3) probe rays and the most used
/// bends find ways across the void; (4) bends slide along mesh edges, all bends of a way together.
/// Values flagged kPath are upper bounds.
///
/// @param mesh  closed, outward oriented [m]; any frame
/// @param hull  of the mesh's vertices
/// @param bvh   over the same mesh, tolerance = diagonal * start_offset / kOffsetOverRayTolerance
/// @return kInvalidInput when the mesh has no face or the hull no facet
/// Complexity O(V log V) rays expected. Pure; the same bytes for any number of threads.
Result<ConcavityField> shortest_path_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                               const TriangleBvh& bvh,
                                               const ConcavityConfig& config);

/// A mesh's hull, its tree for rays and its concavity.
struct MeasuredConcavity {
    OuterHull hull;
    std::shared_ptr<const TriangleBvh> tree;
    ConcavityField field;
    std::vector<StepTime> times;  ///< [ms] in the order of the work; the hull runs beside the tree
};

/// outer_hull, TriangleBvh and shortest_path_concavity at once, side by side where they can be.
/// @param mesh  closed, outward oriented [m]; any frame
/// @return kInvalidInput when the mesh has no face; outer_hull's errors
Result<MeasuredConcavity> measure_concavity(const TriangleMesh& mesh,
                                            const ConcavityConfig& config);

/// The way out from a vertex: the vertex, its bends, and the foot on the hull's plane [m]. Its
/// length is the vertex's value. Empty for enclosed and unreferenced vertices, and for all of the
/// tetrahedral method.
std::vector<Eigen::Vector3d> escape_path(const TriangleMesh& mesh, const OuterHull& hull,
                                         const ConcavityField& field, std::uint32_t vertex);

/// The same way where rays found it free [m]: vertex and bends are lifted off the surface; the last
/// point lies a lift short of the hull's plane, in which the object's own sides may lie.
std::vector<Eigen::Vector3d> tested_path(const TriangleMesh& mesh, const OuterHull& hull,
                                         const ConcavityField& field, std::uint32_t vertex);

/// The bounding box's diagonal of the vertices that faces use [m].
double mesh_diagonal_m(const TriangleMesh& mesh);

/// What a TriangleBvh for shortest_path_concavity needs as its tolerance [m].
double ray_tolerance_m(const TriangleMesh& mesh, const ConcavityConfig& config);

}  // namespace graspd
