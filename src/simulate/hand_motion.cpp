#include "hand_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace graspd::simulate_detail {
namespace {

constexpr double kClose_s = 0.5;
constexpr double kWeight_s = 0.2;  // weight comes on
constexpr double kRise_s = 0.8;
constexpr double kRest_s = 0.1;  // after the lift and after the shaking

// Two periods along or about each axis.
constexpr double kShift_s = 0.4;  // 5 Hz
constexpr double kTurn_s = 0.8;   // 2.5 Hz
constexpr double kPeriods = 2.0;

/// Two periods of a sine under an envelope that rises and falls, share in [0, 1].
double wave(double share) {
    const double envelope = std::sin(std::numbers::pi * share);
    return envelope * envelope * std::sin(2.0 * std::numbers::pi * kPeriods * share);
}

}  // namespace

double duration_s(SimulationPhase phase) {
    switch (phase) {
        case SimulationPhase::kApproach: return 0.0;
        case SimulationPhase::kClose: return kClose_s;
        case SimulationPhase::kLift: return kWeight_s + kRise_s + kRest_s;
        case SimulationPhase::kShake: return 3.0 * (kShift_s + kTurn_s) + kRest_s;
    }
    return 0.0;
}

double weight_share(SimulationPhase phase, double time_s) {
    if (phase < SimulationPhase::kLift) return 0.0;
    return phase == SimulationPhase::kLift ? std::clamp(time_s / kWeight_s, 0.0, 1.0) : 1.0;
}

Eigen::Vector3d lift_at(double time_s, const Eigen::Vector3d& up, const SimulationConfig& config) {
    const double t = std::clamp((time_s - kWeight_s) / kRise_s, 0.0, 1.0);
    return config.lift_m * t * t * t * (10.0 - 15.0 * t + 6.0 * t * t) * up;
}

Eigen::Isometry3d shake_at(double time_s, const SimulationConfig& config) {
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    double start = 0.0;
    for (const bool turns : {false, true}) {
        const double length = turns ? kTurn_s : kShift_s;
        for (const Eigen::Index axis : {0, 1, 2}) {
            const double share = (time_s - start) / length;
            start += length;
            if (share <= 0.0 || share >= 1.0) continue;
            if (turns) {
                move.rotate(
                    Eigen::AngleAxisd(config.shake_rad * wave(share), Eigen::Vector3d::Unit(axis)));
            } else {
                move.translation()[axis] = config.shake_m * wave(share);
            }
        }
    }
    return move;
}

}  // namespace graspd::simulate_detail
