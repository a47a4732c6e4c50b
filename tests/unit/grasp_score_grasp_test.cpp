#include "graspd/grasp/score_grasp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace graspd {
namespace {

// Weights of this test's own, so that calibrating the planner's leaves it as it is.
constexpr ScoreGraspConfig kWeights{.bias = 1.0,
                                    .friction_weight = 2.0,
                                    .balance_weight = 1.0,
                                    .weight_weight = 1.5,
                                    .torque_weight = 4.0,
                                    .contact_weight = 2.0,
                                    .opening_weight = 0.4,
                                    .clearance_weight = 0.5,
                                    .clearance_scale_m = 0.01};

/// Neither good nor bad: half of each merit.
GraspEvidence plain() {
    GraspEvidence evidence;
    evidence.min_friction = 0.3;
    evidence.friction = 0.6;
    evidence.beta_rad = std::numbers::pi / 8.0;
    evidence.loads = {0.5, 0.3, 0.4};
    evidence.contact_share = 0.5;
    evidence.opening_left = 0.25;
    evidence.clearance_m = 0.005;
    return evidence;
}

double term(const GraspScore& score, const std::string& name) {
    for (const ScoreTerm& t : score.terms) {
        if (t.name == name) return t.value;
    }
    ADD_FAILURE() << "no term " << name;
    return 0.0;
}

double score_of(const GraspEvidence& evidence) {
    return score_grasp(evidence, kWeights).score;
}

// Half of the friction unused and half of the pads touching weigh 0; pi/8 is half of 45 degrees:
// -0.5; friction carries the weight twice over: 1.5 ln 2; torsion 0.3 and tilt 0.4 make 0.5, so the
// torques are carried twice over, too: 4 ln 2; a quarter of the opening left: 0.1; clearance half
// of 10 mm: 0.25. Bias 1.
TEST(ScoreGrasp, TermsWorkedByHand) {
    const GraspScore score = score_grasp(plain(), kWeights);
    ASSERT_EQ(score.terms.size(), 8U);
    EXPECT_NEAR(term(score, "bias"), 1.0, 1e-12);
    EXPECT_NEAR(term(score, "friction"), 0.0, 1e-12);
    EXPECT_NEAR(term(score, "balance"), -0.5, 1e-12);
    EXPECT_NEAR(term(score, "weight"), 1.5 * std::log(2.0), 1e-12);
    EXPECT_NEAR(term(score, "torque"), 4.0 * std::log(2.0), 1e-12);
    EXPECT_NEAR(term(score, "contact"), 0.0, 1e-12);
    EXPECT_NEAR(term(score, "opening"), 0.1, 1e-12);
    EXPECT_NEAR(term(score, "clearance"), 0.25, 1e-12);
    EXPECT_NEAR(score.score,
                1.0 / (1.0 + std::exp(-(1.0 - 0.5 + 5.5 * std::log(2.0) + 0.1 + 0.25))), 1e-12);
}

// The best possible: 1 + 2 + 0 + 2 + 0.4 + 0.5, and loads carried twenty times over; more adds
// nothing.
TEST(ScoreGrasp, TheBestGraspHasAllMerits) {
    GraspEvidence best = plain();
    best.min_friction = best.beta_rad = 0.0;
    best.loads = {0.001, 0.0, 0.0};
    best.contact_share = best.opening_left = 1.0;
    best.clearance_m = 0.03;  // more than 10 mm adds nothing
    EXPECT_NEAR(score_of(best), 1.0 / (1.0 + std::exp(-5.9 - 5.5 * std::log(20.0))), 1e-12);
}

TEST(ScoreGrasp, EachWeightScalesItsTerm) {
    const ScoreGraspConfig doubled{.bias = 2.0,
                                   .friction_weight = 4.0,
                                   .balance_weight = 2.0,
                                   .weight_weight = 3.0,
                                   .torque_weight = 8.0,
                                   .contact_weight = 4.0,
                                   .opening_weight = 0.8,
                                   .clearance_weight = 1.0};
    GraspEvidence evidence = plain();
    evidence.min_friction = 0.15;
    evidence.contact_share = 0.8;
    const GraspScore once = score_grasp(evidence, kWeights);
    const GraspScore twice = score_grasp(evidence, doubled);
    ASSERT_EQ(once.terms.size(), twice.terms.size());
    for (std::size_t i = 0; i < once.terms.size(); ++i) {
        EXPECT_EQ(once.terms[i].name, twice.terms[i].name);
        EXPECT_NE(once.terms[i].value, 0.0);
        EXPECT_NEAR(2.0 * once.terms[i].value, twice.terms[i].value, 1e-12) << once.terms[i].name;
    }
}

TEST(ScoreGrasp, TermsSumToTheLogitOfTheScore) {
    for (const double min_friction : {0.0, 0.2, 0.55, 0.9}) {
        for (const double torsion : {0.0, 0.6, 50.0}) {
            for (const double share : {0.0, 0.3, 1.0}) {
                GraspEvidence evidence = plain();
                evidence.min_friction = min_friction;
                evidence.loads.torsion = torsion;
                evidence.contact_share = share;
                const GraspScore score = score_grasp(evidence, kWeights);
                double sum = 0.0;
                for (const ScoreTerm& t : score.terms) sum += t.value;
                EXPECT_GT(score.score, 0.0);
                EXPECT_LT(score.score, 1.0);
                EXPECT_NEAR(std::log(score.score / (1.0 - score.score)), sum, 1e-9);
            }
        }
    }
}

// Better evidence never scores worse; within the stated limits it scores better.
TEST(ScoreGrasp, RisesAndFallsWithTheEvidence) {
    const auto expect_falls = [](double GraspEvidence::*field, std::vector<double> values) {
        GraspEvidence evidence = plain();
        for (std::size_t i = 0; i + 1 < values.size(); ++i) {
            evidence.*field = values[i];
            const double better = score_of(evidence);
            evidence.*field = values[i + 1];
            EXPECT_GT(better, score_of(evidence)) << values[i] << " and " << values[i + 1];
        }
    };
    expect_falls(&GraspEvidence::min_friction, {0.0, 0.1, 0.3, 0.5, 0.6});
    expect_falls(&GraspEvidence::friction, {2.0, 1.0, 0.6, 0.31});
    expect_falls(&GraspEvidence::beta_rad, {0.0, 0.1, 0.5, 1.5, 3.0});
    expect_falls(&GraspEvidence::contact_share, {1.0, 0.6, 0.2, 0.0});
    expect_falls(&GraspEvidence::clearance_m, {0.01, 0.006, 0.001, 0.0});
    GraspEvidence far = plain();
    far.clearance_m = 0.01;
    const double enough = score_of(far);
    far.clearance_m = 0.05;
    EXPECT_DOUBLE_EQ(score_of(far), enough);
}

// The larger a load, the lower the score, whichever it is; beyond twenty times the limit it makes
// no difference.
TEST(ScoreGrasp, FallsWithEveryLoad) {
    for (double LoadRatios::*load : {&LoadRatios::slip, &LoadRatios::torsion, &LoadRatios::tilt}) {
        GraspEvidence light = plain(), heavy = plain(), crushing = plain();
        heavy.loads.*load = 1.5;
        light.loads.*load = 0.2;
        EXPECT_GT(score_of(light), score_of(heavy));
        heavy.loads.*load = 30.0;
        crushing.loads.*load = std::numeric_limits<double>::infinity();
        EXPECT_DOUBLE_EQ(score_of(heavy), score_of(crushing));
    }
}

// 0.5 kg on two fingers at mu 0.6 that needs 0.1 to hold: 4.905 / (2 x 0.5).
TEST(MinGripForce, CarriesTheMassByWhatFrictionIsLeft) {
    EXPECT_NEAR(min_grip_force_N(0.5, 0.6, 0.1), 4.905, 1e-12);
    EXPECT_NEAR(min_grip_force_N(0.1, 0.6, 0.0), 0.981 / 1.2, 1e-12);
    EXPECT_NEAR(min_grip_force_N(1.0, 0.6, 0.1), 9.81, 1e-12);
    EXPECT_EQ(min_grip_force_N(0.5, 0.6, 0.6), std::numeric_limits<double>::infinity());
    EXPECT_EQ(min_grip_force_N(0.5, 0.6, 0.7), std::numeric_limits<double>::infinity());
    EXPECT_EQ(min_grip_force_N(0.5, 0.6, std::numeric_limits<double>::infinity()),
              std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace graspd
