#include "graspd/grasp/score_grasp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "graspd/base/gravity.hpp"

namespace graspd {
namespace {

// Beyond these a grasp is no better for being better and no worse for being worse.
constexpr double kLeastRatio = 0.05, kGreatestRatio = 20.0;

/// How many times over a load is carried, as a logarithm.
double reserve(double load_ratio) {
    return -std::log(std::clamp(load_ratio, kLeastRatio, kGreatestRatio));
}

}  // namespace

GraspScore score_grasp(const GraspEvidence& e, const ScoreGraspConfig& config) {
    const double friction_left = std::clamp(1.0 - e.min_friction / e.friction, 0.0, 1.0);
    const double room = std::clamp(e.clearance_m / config.clearance_scale_m, 0.0, 1.0);

    GraspScore result;
    result.terms = {
        {"bias", config.bias},
        {"friction", config.friction_weight * (2.0 * friction_left - 1.0)},
        {"balance", -config.balance_weight * e.beta_rad / (0.25 * std::numbers::pi)},
        {"weight", config.weight_weight * reserve(e.loads.slip)},
        {"torque", config.torque_weight * reserve(std::hypot(e.loads.torsion, e.loads.tilt))},
        {"contact", config.contact_weight * (2.0 * std::min(e.contact_share, 1.0) - 1.0)},
        {"opening", config.opening_weight * std::clamp(e.opening_left, 0.0, 1.0)},
        {"clearance", config.clearance_weight * room},
    };
    double sum = 0.0;
    for (const ScoreTerm& term : result.terms) sum += term.value;
    result.score = 1.0 / (1.0 + std::exp(-sum));
    return result;
}

double min_grip_force_N(double mass_kg, double friction, double min_friction) {
    if (!(friction > min_friction)) return std::numeric_limits<double>::infinity();
    return mass_kg * kGravity_m_s2 / (2.0 * (friction - min_friction));
}

}  // namespace graspd
