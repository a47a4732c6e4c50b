#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"
#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/planner_config.hpp"
#include "graspd/planner/prepared_object.hpp"

namespace graspd {

/// What a plan was made for, as far as it can be seen.
struct PlanSubject {
    PreparedObjectPtr object;                                ///< not null
    Eigen::Isometry3d X_FO = Eigen::Isometry3d::Identity();  ///< its pose in F
    std::vector<Gripper> grippers;                           ///< of the request, at least one
};

/// How much of it is drawn.
struct PictureLimits {
    std::uint32_t most_faces = 20000;  ///< of the object; as many points of regions; as many of all
                                       ///< hands together; >= 1
    std::uint32_t most_grasps = 10;    ///< the first so many
};

/// A salient concave region.
struct PicturedRegion {
    std::vector<Eigen::Vector3d> points_F;  ///< [m] samples of the surface
    double depth_m = 0.0;                   ///< [m] greatest concavity in it
};

/// A part of a hand, in F [m]: a box, or the hull of a convex part.
using PicturedPart = std::variant<OrientedBox, TriangleMesh>;

/// What there is to see of a plan: plain shapes in F, for whoever draws them.
struct PlanPicture {
    TriangleMesh object_F;            ///< [m] closed, as planned with; coarser where it is large
    std::vector<double> concavity_m;  ///< [m] per vertex of it; infinite where enclosed
    /// [m] end of a scale of colours: the deepest concavity, but no less than what counts as one,
    /// so that a convex body does not show its rounding errors.
    double deepest_m = 0.0;
    std::uint64_t all_faces = 0;                     ///< before the object was made coarser
    std::vector<PicturedRegion> regions;             ///< deepest first
    double spacing_m = 0.0;                          ///< [m] usual distance of a region's points
    std::vector<std::vector<PicturedPart>> hands_F;  ///< by rank, at contact
};

/// Draws the object by its concavity, the concave regions that were searched, and the hands of the
/// best grasps where they touch, with the parts that collisions are checked with.
///
/// The regions are those of the best grasp's gripper, without grasps of the first one. A hand of
/// convex parts with more faces than most_faces / most_grasps is drawn as its three boxes.
///
/// @param grasps  of a reply to a plan of that subject under the same configuration
/// @return kUnknownGripper for a grasp by a gripper that the subject has not; the error of the
///         first stage that fails, which is none for an object that was planned with. Throws
///         Stopped where its thread is told to stop.
/// Cost: that of sampling the surface and finding its regions, some 10 ms. Pure.
Result<PlanPicture> draw_plan(const PlanSubject& subject, std::span<const Grasp> grasps,
                              const PlannerConfig& config, const PictureLimits& limits);

}  // namespace graspd
