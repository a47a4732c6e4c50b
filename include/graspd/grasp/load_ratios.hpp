#pragma once

#include <optional>

#include <Eigen/Core>

#include "graspd/grasp/contact_patch.hpp"

namespace graspd {

/// What the hand has to carry, and how it is moved.
struct LoadRatiosConfig {
    double shake_m_s2 = 5.0;  ///< [m/s2] that the hand may accelerate with, in any direction
    double torsion_length_m =
        0.002;  ///< [m] of a point contact: friction torque over friction force

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("shake_m_s2", self.shake_m_s2, 0.0, 1000.0);
        visit("torsion_length_m", self.torsion_length_m, 0.0, 0.05);
    }
};

/// The object in the hand, in G.
struct HeldLoad {
    Eigen::Vector3d center_of_mass_G = Eigen::Vector3d::Zero();  ///< [m]
    std::optional<Eigen::Vector3d> down_G;  ///< unit, of gravity; absent: any direction
    double mass_kg = 0.1;                   ///< [kg] > 0
    double grip_force_N = 20.0;             ///< [N] per finger, > 0
    double friction = 0.6;                  ///< [1] > 0
    double min_friction = 0.0;              ///< [1] that the lean of the contacts uses up
};

/// Load over what the contacts can carry; 1 is the limit, infinite when they carry nothing.
struct LoadRatios {
    double slip = 0.0;     ///< [1] weight over friction
    double torsion = 0.0;  ///< [1] turning about the closing axis
    double tilt = 0.0;     ///< [1] turning about the worse of Gy and Gz
};

/// Compares weight and shaking with what two pressed patches carry.
///
/// Friction carries forces across Gx and, on the patches' arms, the torque about Gx (Coulomb,
/// elastic foundation). A torque about Gy or Gz moves the pressure to a patch's border and, over
/// the width between the fingers, loads friction.
///
/// Source: none in the paper, which ranks by beta alone (Sec. II-F).
/// Complexity O(1). Pure.
LoadRatios load_ratios(const ContactPatches& patches, const HeldLoad& load,
                       const LoadRatiosConfig& config);

}  // namespace graspd
