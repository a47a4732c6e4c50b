#pragma once

#include <string>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/grasp/load_ratios.hpp"

namespace graspd {

/// One named log-odds contribution to a score.
struct ScoreTerm {
    std::string name;
    double value = 0.0;
};

/// Weights of the score's terms: fitted to what became of 2039 executed grasps of generated shapes
/// (docs/grasp_quality.md). The fit gives friction and balance no weight beside the torques; a
/// little of each, of the opening left and of the clearance decides between grasps alike otherwise.
struct ScoreGraspConfig {
    double bias = 0.15;               ///< log-odds of a grasp without merits or faults
    double friction_weight = 0.1;     ///< of the unused share of the friction coefficient
    double balance_weight = 0.1;      ///< per 45 degrees of the force-balance angle
    double weight_weight = 0.1;       ///< of how often friction carries the weight
    double torque_weight = 3.75;      ///< of how often the contacts carry the torques
    double contact_weight = 1.45;     ///< of the share of the fingers' faces that presses
    double opening_weight = 0.1;      ///< of the share of the opening that is left
    double clearance_weight = 0.1;    ///< of the clearance in units of clearance_scale_m
    double clearance_scale_m = 0.01;  ///< [m] more clearance adds no merit

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("bias", self.bias, -10.0, 10.0);
        visit("friction_weight", self.friction_weight, 0.0, 10.0);
        visit("balance_weight", self.balance_weight, 0.0, 10.0);
        visit("weight_weight", self.weight_weight, 0.0, 10.0);
        visit("torque_weight", self.torque_weight, 0.0, 10.0);
        visit("contact_weight", self.contact_weight, 0.0, 10.0);
        visit("opening_weight", self.opening_weight, 0.0, 10.0);
        visit("clearance_weight", self.clearance_weight, 0.0, 10.0);
        visit("clearance_scale_m", self.clearance_scale_m, 1e-4, 1.0);
    }
};

/// What is known about a grasp and the task.
struct GraspEvidence {
    double min_friction = 0.0;   ///< [1] least coefficient that holds it
    double friction = 0.6;       ///< [1] coefficient of the request, > 0
    double beta_rad = 0.0;       ///< [rad] force balance (II-F)
    LoadRatios loads;            ///< [1] of what the contacts can carry
    double contact_share = 0.0;  ///< [1] of the lesser finger's face that presses
    double mass_kg = 0.1;        ///< [kg]
    double opening_left = 0.0;   ///< [1] share of the gripper's opening beyond the contact width
    double clearance_m = 0.0;    ///< [m] along the motion; what is not known yet counts as 0
};

/// A score with its reasons.
struct GraspScore {
    double score = 0.0;  ///< in (0, 1): 1 / (1 + exp(-sum of terms))
    /// bias, friction, balance, weight, torque, contact, opening, clearance
    std::vector<ScoreTerm> terms;
};

/// Weighs the evidence. Named terms sum to logit(score). A load's term is 0 at the limit of what
/// the contacts carry and grows with the logarithm of the reserve; torques about the closing axis
/// and across it load the same contacts, so they count together.
///
/// Source: Lei & Wisse 2016, Sec. II-F ranks by force balance and manipulability alone.
/// Deviation: friction, weight and contact are weighed too, since beta alone accepts nothing.
/// Complexity O(1). Pure.
GraspScore score_grasp(const GraspEvidence& evidence, const ScoreGraspConfig& config);

/// Grip force per finger that carries a mass by friction alone [N]: m g / (2 (mu - min_friction)).
/// Infinite when the friction is not above the least coefficient.
double min_grip_force_N(double mass_kg, double friction, double min_friction);

}  // namespace graspd
