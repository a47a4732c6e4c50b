#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/linkage.hpp"
#include "graspd/base/result.hpp"

namespace graspd {

/// Where the pads' centres stand at one opening: the linkage of a 2F-85 carries them forward
/// while it closes.
struct PadTravel {
    double opening_m = 0.0;  ///< [m] gap between the pads
    double pad_z_m = 0.0;    ///< [m] pads' centre along the approach axis, from the mounting frame
};

/// What a part of a gripper belongs to; left is at -Gx.
enum class GripperMember : std::uint8_t { kPalm, kFingerLeft, kFingerRight };

/// A rigid convex part: the hull of its points. Without a linkage they are in the mounting frame
/// with the fingers fully open, and a finger's parts go where its pad goes; with one they are in
/// the frame of a joint's link.
struct ConvexPart {
    std::string name;
    GripperMember member = GripperMember::kPalm;
    std::vector<Eigen::Vector3d> points;  ///< [m] 4 or more
    std::int32_t joint = -1;              ///< of the linkage; -1: the mounting frame
};

/// A two-finger gripper as three boxes that open along Gx and approach along Gz (DESIGN: JSON
/// member `gripper`). Mounting frame H: Hz is the approach axis, origin at the flange.
/// In H the palm spans z in [palm_z_m, palm_z_m + palm_depth_m]; at opening `o` the fingers span z
/// in [tip - finger_length_m, tip], tip = pad_z_m(o) + tip_offset_m, and have the gap `o` between
/// them. Convex parts, where there are any, stand for what can collide in place of the boxes, which
/// then bound them (fit_boxes) and still say how the gripper grasps.
struct Gripper {
    std::string name;
    double min_width_m = 0.0;           ///< [m] gap when closed
    double max_width_m = 0.085;         ///< [m] gap when fully open
    double finger_length_m = 0.045;     ///< [m] along Gz
    double finger_width_m = 0.02;       ///< [m] along Gy
    double finger_thickness_m = 0.01;   ///< [m] along Gx
    double tip_offset_m = 0.01;         ///< [m] from the pads' centre to the finger's tip, along Gz
    double palm_width_m = 0.12;         ///< [m] along Gx
    double palm_height_m = 0.04;        ///< [m] along Gy
    double palm_depth_m = 0.08;         ///< [m] along Gz
    double palm_z_m = 0.0;              ///< [m] rear face of the palm in H
    double closing_yaw_rad = 0.0;       ///< [rad] Gx = Hx turned by this about Hz
    std::vector<PadTravel> pad_travel;  ///< rising opening; empty: pads stay in front of the palm
    double pad_width_m = 0.0;           ///< [m] of a pad along Gy; 0: the finger's
    double pad_height_m = 0.0;          ///< [m] of a pad along Gz; 0: twice tip_offset_m
    std::vector<ConvexPart> convex_parts;  ///< empty: the boxes collide
    std::optional<Linkage> linkage;        ///< that moves the convex parts
};

/// A part of the gripper, as a box whose axes are those of G.
struct GripperPart {
    std::string name;           ///< "palm", "finger_left" (at -Gx), "finger_right" (at +Gx)
    Eigen::AlignedBox3d box_G;  ///< [m]
};

/// A convex part in G.
struct PlacedPart {
    GripperMember member = GripperMember::kPalm;
    std::vector<Eigen::Vector3d> points_G;  ///< [m]
};

/// Checks that every dimension is finite, positive where it must be, and that the travel table
/// rises.
/// @return nothing, or kInvalidInput naming the field (as in a profile), its value and its range
std::optional<PlanError> validate(const Gripper& gripper);

/// The pads' centre along Hz at an opening [m], piecewise linear in the table, clamped at its ends.
double pad_z_m(const Gripper& gripper, double opening_m);

/// Pose of the grasp frame in the mounting frame when the pads touch at `contact_width_m`.
/// hand_pose = X_OG * X_HG.inverse() stays constant while the fingers close.
Eigen::Isometry3d grasp_in_hand(const Gripper& gripper, double contact_width_m);

/// The three boxes in G, for a hand that will touch at `contact_width_m` and is open by `opening_m`
/// now. G stands where the pads' centres will be at contact, so on a linkage gripper the open
/// fingers stand further back than the closed ones.
std::vector<GripperPart> gripper_parts(const Gripper& gripper, double contact_width_m,
                                       double opening_m);

/// The convex parts in G, as gripper_parts() gives the boxes; none without convex parts.
std::vector<PlacedPart> placed_parts(const Gripper& gripper, double contact_width_m,
                                     double opening_m);

/// Lets the boxes hold all convex parts at every opening, as far as boxes can: what reaches beyond
/// the plane of a pad into the gap is left out. The pads keep their size.
void fit_boxes(Gripper& gripper);

/// Half the size of a pad along Gy and Gz [m].
Eigen::Vector2d pad_half_size_m(const Gripper& gripper);

}  // namespace graspd
