#pragma once

#include <string>
#include <vector>

#include "graspd/base/result.hpp"

namespace graspd {

/// One named log-odds contribution to a score.
struct ScoreTerm {
    std::string name;
    double value = 0.0;
};

/// Weights of the score's terms. Not calibrated yet: chosen so that the terms weigh alike.
struct ScoreGraspConfig {
    double bias = 1.0;                ///< log-odds of a grasp without merits or faults
    double friction_weight = 2.0;     ///< of the unused share of the friction coefficient
    double balance_weight = 1.0;      ///< per 45 degrees of the force-balance angle
    double lever_weight = 4.0;        ///< per unit of weight torque over friction torque
    double contact_weight = 2.0;      ///< of the share of the pads that touches
    double clearance_weight = 0.5;    ///< of the clearance in units of clearance_scale_m
    double clearance_scale_m = 0.01;  ///< [m] more clearance adds no merit

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("bias", self.bias, -10.0, 10.0);
        visit("friction_weight", self.friction_weight, 0.0, 10.0);
        visit("balance_weight", self.balance_weight, 0.0, 10.0);
        visit("lever_weight", self.lever_weight, 0.0, 10.0);
        visit("contact_weight", self.contact_weight, 0.0, 10.0);
        visit("clearance_weight", self.clearance_weight, 0.0, 10.0);
        visit("clearance_scale_m", self.clearance_scale_m, 1e-4, 1.0);
    }
};

/// What is known about a grasp and the task.
struct GraspEvidence {
    double min_friction = 0.0;       ///< [1] least coefficient that holds it
    double friction = 0.6;           ///< [1] coefficient of the request, > 0
    double beta_rad = 0.0;           ///< [rad] force balance (II-F)
    double lever_m = 0.0;            ///< [m] from the centre of mass to the closing line
    double mass_kg = 0.1;            ///< [kg]
    double grip_force_N = 20.0;      ///< [N] per finger, > 0
    double contact_share = 0.0;      ///< [1] the lesser pad's touching share
    double contact_radius_m = 0.01;  ///< [m] of the pad, for the torque that friction carries
    double clearance_m = 0.0;        ///< [m] along the motion; what is not known yet counts as 0
};

/// A score with its reasons.
struct GraspScore {
    double score = 0.0;            ///< in (0, 1): 1 / (1 + exp(-sum of terms))
    std::vector<ScoreTerm> terms;  ///< bias, friction, balance, lever, contact, clearance
};

/// Weighs the evidence. Named terms sum to logit(score).
///
/// Source: Lei & Wisse 2016, Sec. II-F ranks by force balance and manipulability alone.
/// Deviation: friction, weight and contact are weighed too, since beta alone accepts nothing.
/// Complexity O(1). Pure.
GraspScore score_grasp(const GraspEvidence& evidence, const ScoreGraspConfig& config);

/// Grip force per finger that carries a mass by friction alone [N]: m g / (2 (mu - min_friction)).
/// Infinite when the friction is not above the least coefficient.
double min_grip_force_N(double mass_kg, double friction, double min_friction);

}  // namespace graspd
