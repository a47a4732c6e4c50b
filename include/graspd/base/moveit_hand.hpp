#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace graspd {

/// Where a joint stands at one gap between the pads.
struct JointAtOpening {
    double opening_m = 0.0;  ///< [m]
    double position = 0.0;   ///< [rad], or [m] of one that slides
};

/// A joint of a gripper that a MoveIt controller commands.
struct MoveItJoint {
    std::string name;                       ///< in the robot's URDF
    bool slides = false;                    ///< its effort is the grip force
    std::vector<JointAtOpening> positions;  ///< rising opening, at least one
};

/// What MoveIt knows of a gripper profile: the link that its poses are of, and its joints.
struct MoveItHand {
    std::string gripper;      ///< name of the profile
    std::string parent_link;  ///< of the end effector; empty: the mounting frame itself
    Eigen::Isometry3d X_HP = Eigen::Isometry3d::Identity();  ///< that link in the mounting frame
    std::vector<MoveItJoint> joints;                         ///< empty: postures are left empty
};

/// The joint's position at an opening [m]: piecewise linear in the table, clamped at its ends.
inline double position_at(const MoveItJoint& joint, double opening_m) {
    const auto& rows = joint.positions;
    if (rows.empty()) return 0.0;
    if (opening_m <= rows.front().opening_m) return rows.front().position;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (opening_m > rows[i].opening_m) continue;
        const double share =
            (opening_m - rows[i - 1].opening_m) / (rows[i].opening_m - rows[i - 1].opening_m);
        return rows[i - 1].position + share * (rows[i].position - rows[i - 1].position);
    }
    return rows.back().position;
}

}  // namespace graspd
