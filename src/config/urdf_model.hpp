#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"

namespace graspd::config_detail {

/// Which of a URDF's links and joints make the gripper.
struct UrdfNames {
    std::string mount_link;    ///< whose frame is H: z is the approach
    std::string driver_joint;  ///< all other joints stand still or mimic it
    std::map<GripperMember, std::vector<std::string>> links;
    std::string left_pad_link, right_pad_link;
};

/// What a URDF tells of them.
struct UrdfModel {
    Linkage linkage;  ///< joints; pads name their joints; open_q, closed_q: the driver's limits
    std::vector<ConvexPart> parts;  ///< the hull of every collision geometry of the members' links
};

/// Reads a URDF with urdfdom. Boxes, cylinders, spheres and meshes (what read_object reads) become
/// hulls; of a cylinder or a sphere a hull of 24 sides that holds it.
/// @return kUnreadableFile when the file or a mesh cannot be read; kInvalidInput with the name and
///         value for a link or joint that is missing, moves otherwise, or has no collision geometry
Result<UrdfModel> read_urdf(const std::filesystem::path& file, const UrdfNames& names);

}  // namespace graspd::config_detail
