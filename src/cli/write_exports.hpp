#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export_hand.hpp"
#include "read_grasps.hpp"

namespace graspd::cli {

/// What the reply does not know about the tool that reads the export. docs/exports.md says what
/// each format makes of it.
struct ExportOptions {
    std::string object;  ///< the object's name in the other tool; empty: see each format
    std::string link;    ///< the name of the link whose pose is written; empty: see each format
    std::optional<Eigen::Isometry3d> X_HL;  ///< that link in the mounting frame; absent: ditto
    double object_scale = 1.0;              ///< from the object file's numbers to metres
    std::optional<double> hand_depth_m;     ///< [m] GPD's; absent: the length of the fingers
};

// One function a format. All poses are in the reply's frame F; metres, radians, newtons. Numbers
// read back as the same double. Pure; the grasps keep the file's order.

/// moveit_msgs/msg/Grasp as YAML, one document a grasp, separated by "---", as `ros2 topic pub
/// --yaml-file` takes it. The fields are those that the daemon's service /plan_grasps fills in
/// (docs/interface.md, MoveIt): grasp_pose is of the parent link, X_FH * X_HL.
/// @param hands  one for each gripper of the grasps, or kUnknownGripper
Result<std::string> write_moveit_yaml(const GraspFile& file, std::span<const ExportHand> hands,
                                      const ExportOptions& options);

/// An Isaac grasp file, format version 1.0: the pose of the gripper frame, by default H, in the
/// object frame, which is F; the joints at the contact width and at the pre-shape.
/// @param hands  as above
/// @return kInvalidInput for grasps of more than one gripper, as such a file is about one
Result<std::string> write_isaac_grasp(const GraspFile& file, std::span<const ExportHand> hands,
                                      const ExportOptions& options);

/// A table for spreadsheets and scripts: a heading, then one line a grasp; names end in their unit.
std::string write_grasp_csv(const GraspFile& file);

/// gpd_ros/GraspConfigList as YAML, one message (tcp_to_gpd()).
/// @param hands  as above
Result<std::string> write_gpd_yaml(const GraspFile& file, std::span<const ExportHand> hands,
                                   const ExportOptions& options);

/// A file of GraspGen's grasp data set as JSON: matrices of the base link (tcp_to_graspgen()).
/// @return kInvalidInput without options.object, the mesh's path in their data set, and for grasps
///         of more than one gripper
Result<std::string> write_graspgen_json(const GraspFile& file, const ExportOptions& options);

}  // namespace graspd::cli
