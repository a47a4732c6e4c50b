#pragma once

#include <string>
#include <vector>

#include "convert_basics.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::dds {

/// What a CollisionObject is made of.
struct CollisionParts {
    Eigen::Isometry3d X_FO = Eigen::Isometry3d::Identity();  ///< the object's pose
    std::vector<TriangleMesh> solids_O;  ///< [m] meshes, then primitives, where they stand in O
    std::vector<SupportPlane> planes_F;  ///< either side may be the solid one
};

/// Most meshes and primitives, and most planes, of one object.
inline constexpr std::size_t kMostParts = 256;

/// Notes a frame at `path` that is neither empty nor the target's.
void check_frame(const std::string& frame, const std::string& path, const std::string& frame_id,
                 FirstError& errors);

/// Reads an object that is to be there. A part without a pose stands at the object's own, as
/// MoveIt takes it; curved primitives become meshes (base/solid_meshes.hpp). Names, the type and
/// the subframes say nothing about its shape and are not looked at.
///
/// Notes the first field that is wrong by its path below `path`: an operation other than ADD or
/// APPEND, a frame other than `frame_id` (empty: the same), more poses than parts, a pose, a
/// vertex, an index or a dimension that is none, a primitive that is not served (PRISM).
CollisionParts read_collision_object(const moveit_msgs::msg::dds_::CollisionObject_& object,
                                     const std::string& path, const std::string& frame_id,
                                     FirstError& errors);

}  // namespace graspd::dds
