#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/result.hpp"

namespace graspd {

/// A joint of a gripper's mechanism together with the link behind it. All joints follow one driver
/// position q: this one's position is multiplier q + offset, in radians or, sliding, in metres.
struct LinkageJoint {
    std::string name;
    std::int32_t parent = -1;  ///< joint whose link carries this one; -1: the mounting frame H
    Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();  ///< in the parent's link, position 0
    Eigen::Vector3d axis_J = Eigen::Vector3d::UnitZ();       ///< unit
    bool slides = false;  ///< along the axis, else turns about it
    double multiplier = 1.0;
    double offset = 0.0;  ///< [rad] or [m]
};

/// Where the middle of a pad's face is fixed.
struct PadMount {
    std::int32_t joint = -1;                          ///< on this joint's link; -1: in H
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< [m]
};

/// A one-driver mechanism that opens and closes two pads.
struct Linkage {
    std::vector<LinkageJoint> joints;     ///< parents before their children
    double open_q = 0.0, closed_q = 0.0;  ///< driver at the widest and the narrowest opening
    std::array<PadMount, 2> pads;         ///< left (at -Gx), right
    Eigen::Vector3d closing_axis_H = Eigen::Vector3d::UnitX();  ///< unit: Gx
};

/// Checks the order of the joints, unit axes and finite numbers, and that the gap falls strictly
/// from open_q to closed_q.
/// @return nothing, or kInvalidInput naming the joint or the field and its value
std::optional<PlanError> validate(const Linkage& linkage);

/// Pose of every joint's link in H at a driver position. Exact forward kinematics.
std::vector<Eigen::Isometry3d> link_poses_H(const Linkage& linkage, double q);

/// A pad's middle in H [m]; left 0, right 1.
Eigen::Vector3d pad_point_H(const Linkage& linkage, std::size_t pad, double q);

/// Gap between the pads' faces along the closing axis [m].
double pad_gap_m(const Linkage& linkage, double q);

/// The driver position at which the pads are `opening_m` apart, clamped to the range; by false
/// position (Illinois), to 1e-15 m of the gap.
double driver_position(const Linkage& linkage, double opening_m);

/// How far a point of a joint's link leaves the straight line between its places at two driver
/// positions: at most sagitta_bound times the squared step [m per unit squared]. For a single hinge
/// r (1 - cos(step / 2)) <= r step^2 / 8.
/// @param reach_m  [m] greatest distance of the point from the joint's origin
double sagitta_bound(const Linkage& linkage, std::int32_t joint, double reach_m);

}  // namespace graspd
