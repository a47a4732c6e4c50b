#include "graspd/grasp/load_ratios.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "graspd/base/gravity.hpp"

namespace graspd {
namespace {

double ratio(double load, double capacity) {
    return capacity > 0.0 ? load / capacity : std::numeric_limits<double>::infinity();
}

/// Greatest torque about an axis of G [Nm] by weight and shaking at the arm `arm_G`.
double torque_Nm(const Eigen::Vector3d& arm_G, int axis, const HeldLoad& load, double shake_m_s2) {
    Eigen::Vector3d across = arm_G;
    across[axis] = 0.0;
    const double weight = load.down_G ? std::abs(arm_G.cross(*load.down_G)[axis]) : across.norm();
    return load.mass_kg * (kGravity_m_s2 * weight + shake_m_s2 * across.norm());
}

}  // namespace

LoadRatios load_ratios(const ContactPatches& patches, const HeldLoad& load,
                       const LoadRatiosConfig& config) {
    const ContactPatch& left = patches.left;
    const ContactPatch& right = patches.right;
    const Eigen::Vector3d arm_G = load.center_of_mass_G - 0.5 * (left.center_G + right.center_G);
    const double width_m = std::max(0.0, right.center_G.x() - left.center_G.x());
    const double press_N = load.grip_force_N;
    const double friction_N = press_N * std::max(0.0, load.friction - load.min_friction);
    const auto torque = [&](int axis) { return torque_Nm(arm_G, axis, load, config.shake_m_s2); };

    LoadRatios ratios;
    ratios.slip = ratio(load.mass_kg * (kGravity_m_s2 + config.shake_m_s2), 2.0 * friction_N);
    const double arms_m = left.mean_radius_m + right.mean_radius_m + 2.0 * config.torsion_length_m;
    ratios.torsion = ratio(torque(0), load.friction * press_N * arms_m);
    const double couple_Nm = load.friction * press_N * width_m;
    ratios.tilt =
        std::max(ratio(torque(1), press_N * (left.half_height_m + right.half_height_m) + couple_Nm),
                 ratio(torque(2), press_N * (left.half_width_m + right.half_width_m) + couple_Nm));
    return ratios;
}

}  // namespace graspd
