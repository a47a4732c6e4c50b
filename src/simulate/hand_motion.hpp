#pragma once

#include <Eigen/Geometry>

#include "graspd/simulate/simulate_grasp.hpp"

namespace graspd::simulate_detail {

// The path of the hand once it has closed, as displacements in time from the start of a phase.

/// [s] How long the phases last that physics decides; 0 for kApproach.
double duration_s(SimulationPhase phase);

/// The share of the object's weight that is on, in [0, 1].
double weight_share(SimulationPhase phase, double time_s);

/// Displacement that lifts by config.lift_m along `up`, with neither speed nor acceleration at both
/// ends (minimum jerk), once the weight is on.
Eigen::Vector3d lift_at(double time_s, const Eigen::Vector3d& up, const SimulationConfig& config);

/// Displacement in G: along x, y, z, then about x, y, z, one after the other.
Eigen::Isometry3d shake_at(double time_s, const SimulationConfig& config);

}  // namespace graspd::simulate_detail
