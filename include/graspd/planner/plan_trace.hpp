#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/planner/plan_types.hpp"
#include "graspd/regions/cluster_concavities.hpp"

namespace graspd {

// What a plan saw on its way, for people who want to look at it: plan() fills a PlanTrace where it
// is given one. It holds what counts of the work, in the order of the search whatever the number of
// threads: work that was thrown away, and the plans for a suggestion, are not in it. All lengths in
// P, the object's principal frame.

/// The object as the stages saw it (II-A).
struct TracedObject {
    TriangleMesh mesh_P;              ///< [m] conditioned
    std::vector<double> concavity_m;  ///< [m] per vertex; +inf enclosed, NaN unreferenced
    double deepest_m = 0.0;           ///< [m] the greatest finite one
    std::vector<ConcavityFlag> flag;  ///< per vertex
    std::vector<std::uint32_t> hull;  ///< rising indices of the vertices that span the hull
    double volume_m3 = 0.0;           ///< [m^3]
    Eigen::Vector3d center_of_mass_P = Eigen::Vector3d::Zero();  ///< [m] as the plan used it
};

/// The boundary of one concavity in one working plane (II-D, II-E).
struct TracedBoundary {
    std::int32_t concavity = -1;                             ///< index in TracedSearch
    Eigen::Isometry3d X_PW = Eigen::Isometry3d::Identity();  ///< working frame, Wz the normal
    std::vector<Eigen::Vector3d> ordered_P;  ///< [m] boundary points, at the surface's mean height
    std::vector<Eigen::Vector3d> steps_P;    ///< [m] step points, likewise
};

/// What one gripper's search saw of the object (II-B to II-E).
struct TracedSearch {
    std::string gripper_name;
    SurfaceSamples surface_P;
    std::vector<Concavity> concavities;      ///< of surface_P, deepest first
    std::vector<TracedBoundary> boundaries;  ///< by concavity, then best plane first; only those
                                             ///< with two points and more
};

/// One candidate and what became of it: a closing axis before any hand was tried on it (its typed
/// reason begins with axis_), or the pose of a hand.
struct TracedCandidate {
    static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

    Eigen::Isometry3d X_PG = Eigen::Isometry3d::Identity();  ///< where it stood when it fell
    double width_m = 0.0;  ///< [m] between the two places, or pads where they touched
    std::string gripper_name;
    GraspSource source = kBoundary;
    std::int32_t concavity = -1;     ///< index of the region; -1: none
    std::string reason;              ///< that felled it, as in PlanReport; empty: in the reply
    double margin = kUnknown;        ///< by how much it failed, in `unit`
    std::string unit;                ///< "m", "rad" or "1"; empty without a margin
    double beta_rad = kUnknown;      ///< [rad] force balance (II-F), where it came so far
    double min_friction = kUnknown;  ///< [1] likewise
    double score = kUnknown;         ///< [1] of those that hold and are free
};

/// Everything of one plan. Empty parts: the plan ended before them.
struct PlanTrace {
    Eigen::Isometry3d X_FP = Eigen::Isometry3d::Identity();  ///< pose of P in the request's frame
    TracedObject object;
    std::vector<TracedSearch> searches;  ///< one a gripper, in the request's order
    /// Those that fell, in the order in which they fell; then the reply's grasps, best first. So
    /// there are as many of each reason as PlanReport counts.
    std::vector<TracedCandidate> candidates;
};

}  // namespace graspd
