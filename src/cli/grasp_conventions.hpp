#pragma once

#include <Eigen/Geometry>

#include "graspd/base/gripper.hpp"

namespace graspd::cli {

// One grasp as the poses that other tools want. All lengths in metres; X_AB takes coordinates of B
// to A. F is any frame that the poses are in. G is our grasp frame: origin midway between the pads'
// centres at contact (TCP), Gx closing, Gz approach, Gy = Gz x Gx. H is the gripper's mounting
// frame (docs/interface.md). Each pair of functions is exact: one undoes the other.
//
// A two-finger hand turned by 180 degrees about its approach axis is the same hand, so the sign of
// the closing axis carries over but means nothing.

/// Where GPD puts the base of the hand, as z in G: the fingertips of the open hand less its depth.
/// The fingertips are those before the fingers close, as in GPD; where pads travel forward while
/// closing, they are not where they will be at contact.
///
/// Source: github.com/atenpas/gpd 6327f20, src/gpd/candidate/finger_hand.cpp (bottom = bite -
/// hand_depth, top = fingertip) and hand.cpp (position = bottom, between the fingers).
/// @param hand_depth_m  GPD's `hand_depth`, the length of the fingers, > 0
double gpd_base_z_G_m(const Gripper& gripper, double width_m, double open_width_m,
                      double hand_depth_m);

/// Our pose as GPD's hand frame D: Dx approach, Dy binormal (closing), Dz hand axis; origin at the
/// hand's base, in the middle between the fingers.
///
/// Source: include/gpd/candidate/hand.h of the same repository (columns of `orientation_`),
/// github.com/atenpas/gpd_ros 9ae5241, msg/GraspConfig.msg.
/// @param base_z_G_m  gpd_base_z_G_m(), negative
Eigen::Isometry3d tcp_to_gpd(const Eigen::Isometry3d& X_FG, double base_z_G_m);
/// The inverse of tcp_to_gpd().
Eigen::Isometry3d gpd_to_tcp(const Eigen::Isometry3d& X_FD, double base_z_G_m);

/// Our pose as GraspGen's base link frame B: Bz approach, Bx closing; origin at the gripper's base
/// link, `depth_m` behind the TCP. It is our H turned about Hz so that Bx is the closing axis.
///
/// Source: github.com/NVlabs/GraspGen a56d518, docs/GRIPPER_DESCRIPTION.md (axes, depth) and
/// docs/GRASP_DATASET_FORMAT.md (matrices are of the base link).
/// @param depth_m  from B's origin to the TCP along Bz
Eigen::Isometry3d tcp_to_graspgen(const Eigen::Isometry3d& X_FG, double depth_m);
/// The inverse of tcp_to_graspgen().
Eigen::Isometry3d graspgen_to_tcp(const Eigen::Isometry3d& X_FB, double depth_m);

/// Our pose as that of a link L which is fixed to the hand: MoveIt's parent link of the end
/// effector, or the gripper frame of an Isaac grasp file.
///
/// Source: github.com/moveit/moveit_msgs, msg/Grasp.msg (grasp_pose); Isaac Sim's manual, page
/// "Grasp Editor" (position and orientation of the gripper frame in the object frame).
/// @param X_HG  grasp_in_hand() at the contact width
/// @param X_HL  the link in the mounting frame, as `moveit.parent_xyz` and `parent_rpy` say it
Eigen::Isometry3d tcp_to_link(const Eigen::Isometry3d& X_FG, const Eigen::Isometry3d& X_HG,
                              const Eigen::Isometry3d& X_HL);
/// The inverse of tcp_to_link().
Eigen::Isometry3d link_to_tcp(const Eigen::Isometry3d& X_FL, const Eigen::Isometry3d& X_HG,
                              const Eigen::Isometry3d& X_HL);

}  // namespace graspd::cli
