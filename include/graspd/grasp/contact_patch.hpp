#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

/// How a finger's face is probed, and how far it gives way.
struct ContactPatchConfig {
    std::uint32_t lines_across = 5;  ///< along Gy, over the finger's width
    std::uint32_t lines_along = 9;   ///< along Gz, over the finger's length
    double compression_m = 0.001;    ///< [m] at the first touch when the fingers press

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("lines_across", self.lines_across, 2u, 100u);
        visit("lines_along", self.lines_along, 2u, 100u);
        visit("compression_m", self.compression_m, 1e-5, 0.01);
    }
};

/// The inner face of a finger, and where it comes from.
struct FingerFace {
    double half_width_m = 0.01;  ///< [m] along Gy
    double from_z_m = -0.035;    ///< [m] end at the palm
    double to_z_m = 0.01;        ///< [m] tip
    double half_reach_m = 0.05;  ///< [m] along Gx: the faces start so far from the TCP
};

/// Where a finger presses: its pressure is that of an elastic foundation, so it falls linearly with
/// the depth behind the first touch.
struct ContactPatch {
    Eigen::Vector3d center_G = Eigen::Vector3d::Zero();  ///< [m] of pressure
    double mean_radius_m = 0.0;  ///< [m] mean distance from the centre: friction's arm in torsion
    double half_width_m = 0.0;   ///< [m] along Gy: how far the pressure can move before it tips
    double half_height_m = 0.0;  ///< [m] along Gz
    double share = 0.0;          ///< [1] of the face that presses, weighed by pressure
};

/// Both fingers' patches.
struct ContactPatches {
    ContactPatch left, right;  ///< the fingers at -Gx and +Gx
};

/// Presses both fingers' whole inner faces on the object, each from its own side.
///
/// Source: none in the paper, whose local cloud has no extent (Sec. II-E, Fig. 17).
///
/// @param tree_W  over the object's mesh [m]
/// @param X_WG    grasp frame
/// @return the patches; kDegenerate when a finger meets nothing or begins inside the object;
///         kInvalidInput for a parameter out of range
/// Complexity O(lines log F). Pure, so safe to call from any thread.
Result<ContactPatches> contact_patches(const TriangleBvh& tree_W, const Eigen::Isometry3d& X_WG,
                                       const FingerFace& face, const ContactPatchConfig& config);

}  // namespace graspd
