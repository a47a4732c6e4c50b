// The search for a suggestion, with planners of our own whose answers are known.

#include "graspd/base/stop.hpp"
#include "suggest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "support/plan_samples.hpp"
#include "support/suggestion.hpp"

namespace graspd::planner_detail {
namespace {

using Holds = std::function<bool(const PlanRequest&)>;

/// Plans again with a planner that finds one grasp where `holds` says so.
struct Fake {
    PlanRequest request = test::small_request();
    Rejections rejections;
    std::vector<Grasp> grasps;  ///< of the first plan
    Grasp grasp;                ///< what the planner finds
    Holds holds;
    std::uint64_t plans_allowed = 1000, plans = 0;

    Suggestion ask(const SuggestConfig& config = {}) {
        plans = 0;
        return suggest({request, grasps, rejections, 0.2}, config, [&](const PlanRequest& changed) {
            if (++plans > plans_allowed) throw Stopped{};
            return holds(changed) ? std::vector<Grasp>{grasp} : std::vector<Grasp>{};
        });
    }
    void miss(const char* reason, double margin) {
        rejections.add_miss(reason, Eigen::Isometry3d::Identity(), margin, "1", 1.0);
    }
};

Fake slippery(double friction_needed) {
    Fake fake;
    fake.request.options.friction = 0.5;
    fake.holds = [=](const PlanRequest& r) { return r.options.friction >= friction_needed; };
    fake.grasp.score = 0.6249;
    return fake;
}

TEST(Suggest, WhatTheNearestMissNeedsIsEnough) {
    Fake fake = slippery(0.7316);
    fake.miss("slips", 0.2316);
    fake.miss("slips", 0.4);
    const Suggestion suggestion = fake.ask();
    EXPECT_EQ(suggestion.text,
              "with friction 0.732 instead of 0.5 there is a grasp of score 0.625");
    EXPECT_EQ(suggestion.plans, 1U);
}

// A miss of exactly 0.2 needs 0.7; one step of the grid more leaves room for rounding.
TEST(Suggest, OnTheGridThereIsRoomForRounding) {
    Fake fake = slippery(0.7);
    fake.miss("slips", 0.2);
    EXPECT_EQ(test::read_suggestion(fake.ask().text).to["friction"], 0.701);
}

// The nearest miss fails by something else too: then between 0.6 and 1.5 to 2^-k of that.
TEST(Suggest, BisectsTheLeastRelaxation) {
    Fake fake = slippery(0.9);
    fake.grasp.min_friction = 0.0;  // says nothing
    fake.miss("slips", 0.0999);
    for (const std::uint32_t bisections : {0U, 1U, 4U, 6U, 20U}) {
        SuggestConfig config;
        config.bisections = bisections;
        const Suggestion suggestion = fake.ask(config);
        const double friction = test::read_suggestion(suggestion.text).to["friction"];
        EXPECT_GE(friction, 0.9) << bisections;
        EXPECT_LE(friction, 0.9 + 0.9 * std::pow(0.5, bisections) + 0.002) << bisections;
        EXPECT_LE(suggestion.plans, 2 + bisections);
    }
    // With bisections to spare it ends where two values are neighbours: 0.9 or one step above.
    SuggestConfig config;
    config.bisections = 50;
    EXPECT_LE(test::read_suggestion(fake.ask(config).text).to["friction"], 0.901);
    EXPECT_LE(fake.plans, 14U);
}

// What the grasp found at the loosest value needs is tried before the middle.
TEST(Suggest, AsksForNoMoreThanTheGraspNeeds) {
    Fake fake = slippery(0.9);
    fake.grasp.min_friction = 0.8996;
    fake.miss("slips", 0.0999);
    SuggestConfig config;
    config.bisections = 1;
    EXPECT_EQ(test::read_suggestion(fake.ask(config).text).to["friction"], 0.9);
}

// A fifth more opening is less than twice the friction, whichever comes first.
TEST(Suggest, TheLimitThatGivesWayLeastIsNamed) {
    Fake fake;
    fake.request.options.friction = 0.5;
    fake.holds = [](const PlanRequest& r) {
        return r.options.friction >= 1.0 || r.grippers.front().max_width_m >= 0.102;
    };
    fake.miss("slips", 0.4995);
    fake.miss("axis_too_wide", 0.0169);
    EXPECT_EQ(fake.ask().text,
              "with max_width 0.102 m instead of 0.085 m (parallel_85) there is a grasp of score "
              "0.000");
    EXPECT_EQ(fake.plans, 1U);  // friction need not be asked
    fake.request.options.friction = 0.98;
    fake.rejections = {};
    fake.miss("slips", 0.0195);
    fake.miss("axis_too_wide", 0.0169);
    EXPECT_EQ(fake.ask().plans, 1U);
    EXPECT_EQ(fake.ask().text, "with friction 1 instead of 0.98 there is a grasp of score 0.000");
}

TEST(Suggest, OfSeveralGrippersTheWidestOpensWider) {
    Fake fake;
    fake.request.grippers = {Gripper{}, Gripper{}, Gripper{}};
    fake.request.grippers[0].name = "small";
    fake.request.grippers[0].max_width_m = 0.05;
    fake.request.grippers[1].name = "large";
    fake.request.grippers[1].max_width_m = 0.09;
    fake.request.grippers[2].name = "as large";
    fake.request.grippers[2].max_width_m = 0.09;
    fake.holds = [](const PlanRequest& r) {
        EXPECT_EQ(r.grippers[0].max_width_m, 0.05);
        EXPECT_EQ(r.grippers[2].max_width_m, 0.09);
        return r.grippers[1].max_width_m >= 0.1;
    };
    fake.miss("too_wide", 0.00995);
    EXPECT_NE(fake.ask().text.find("max_width 0.1 m instead of 0.09 m (large)"), std::string::npos)
        << fake.ask().text;
}

// Two cones: each that is narrower becomes as wide; from pi on there are none.
TEST(Suggest, ApproachConesAreWidened) {
    Fake fake;
    fake.request.approach_cones = {{Eigen::Vector3d::UnitX(), 0.2},
                                   {-Eigen::Vector3d::UnitZ(), 1.0}};
    fake.rejections.add("outside_approach_cones", 7);            // lines blocked too: no margin
    fake.grasp.approach.direction_F = Eigen::Vector3d::UnitY();  // at right angles to both
    fake.holds = [](const PlanRequest& r) {
        return r.approach_cones.empty() || (r.approach_cones[0].half_angle_rad >= 1.57 &&
                                            r.approach_cones[1].half_angle_rad >= 1.57);
    };
    SuggestConfig config;
    config.bisections = 1;
    EXPECT_NE(fake.ask(config).text.find(
                  "with half_angle 1.571 rad instead of 0.2 rad (approach_cones) there"),
              std::string::npos)
        << fake.ask(config).text;
    fake.holds = [](const PlanRequest& r) { return r.approach_cones.empty(); };
    EXPECT_EQ(fake.ask(config).text, "with no approach_cones there is a grasp of score 0.000");
}

TEST(Suggest, SourcesThatWereLeftOutMayHelp) {
    Fake fake;
    fake.request.options.sources = kBoundary | kWall;
    fake.holds = [](const PlanRequest& r) { return r.options.sources == kAllSources; };
    EXPECT_EQ(fake.ask().text,
              "with sources boundary,wall,whole_object instead of boundary,wall there is a grasp "
              "of score 0.000");
}

// Opening and cones at once; friction and clearance are not needed and stay.
TEST(Suggest, NamesTheTwoThatAreNeededTogether) {
    Fake fake;
    fake.request.approach_cones = {{Eigen::Vector3d::UnitX(), 0.2}};
    fake.request.options.min_clearance_m = 0.001;
    fake.grasp.approach.direction_F = Eigen::Vector3d(1.0, 1.0, 0.0).normalized();
    fake.grasp.open_width_m = 0.11995;
    fake.grasp.score = 0.5;
    fake.holds = [](const PlanRequest& r) {
        const bool open = r.grippers.front().max_width_m >= 0.11;
        return open && (r.approach_cones.empty() || r.approach_cones[0].half_angle_rad >= 0.7);
    };
    fake.miss("axis_too_wide", 0.02);
    EXPECT_EQ(fake.ask().text,
              "no single limit is enough: with half_angle 0.786 rad instead of 0.2 rad "
              "(approach_cones) and max_width 0.12 m instead of 0.085 m (parallel_85) there is a "
              "grasp of score 0.500");
}

TEST(Suggest, SaysWhenNothingHelps) {
    Fake fake;
    fake.holds = [](const PlanRequest&) { return false; };
    fake.miss("slips", 0.1);
    EXPECT_EQ(fake.ask().text, "no grasp even with max_width 0.2001 m and friction 1.5 together");
    fake.request.options.friction = 2.0;
    fake.request.grippers.front().max_width_m = 0.3;
    EXPECT_EQ(fake.ask().text, "no grasp, and the request sets no limit that could be relaxed");
    EXPECT_EQ(fake.plans, 0U);
}

// With grasps: friction would raise every score, so it does not count; clearance raises it less
// than the opening, and the opening is only what the better grasp needs.
TEST(Suggest, WithGraspsTheGreatestGainIsNamed) {
    Fake fake = slippery(0.0);
    fake.grasps.emplace_back();
    fake.grasps.front().score = 0.5;
    fake.request.options.min_clearance_m = 0.02;
    fake.grasp.open_width_m = 0.11995;
    fake.holds = [&](const PlanRequest& r) {
        fake.grasp.score = 0.5;
        if (r.options.friction > 0.5) fake.grasp.score = 0.9;
        if (r.options.min_clearance_m < 0.02) fake.grasp.score = 0.6;
        if (r.grippers.front().max_width_m >= 0.12) fake.grasp.score = 0.7;
        return true;
    };
    EXPECT_EQ(
        fake.ask().text,
        "no limit keeps out a grasp that is better by 0.010 than 0.500: no candidate fell by one");
    EXPECT_EQ(fake.plans, 0U);
    fake.miss("slips", 0.1);
    fake.miss("too_wide", 0.1);
    fake.miss("clearance", 0.1);
    EXPECT_EQ(fake.ask().text,
              "with max_width 0.12 m instead of 0.085 m (parallel_85) the best score is 0.700 "
              "instead of 0.500");
    fake.grasps.front().score = 0.698;  // less than least_gain
    EXPECT_EQ(
        fake.ask().text,
        "no limit keeps out a grasp that is better by 0.010 than 0.698: tried min_clearance 0 m "
        "and max_width 0.2001 m");
}

// The wider gripper's grasp would fit the one at hand: its opening is not what was lacking.
TEST(Suggest, WhatALimitDoesNotKeepOutIsNoReasonToRelaxIt) {
    Fake fake = slippery(0.0);
    fake.grasps.emplace_back();
    fake.grasps.front().score = 0.5;
    fake.grasp.score = 0.7;
    fake.grasp.open_width_m = 0.06;
    fake.miss("too_wide", 0.1);
    EXPECT_EQ(fake.ask().text,
              "no limit keeps out a grasp that is better by 0.010 than 0.500: tried max_width "
              "0.2001 m");
    fake.grasp.open_width_m = 0.0851;
    EXPECT_EQ(test::read_suggestion(fake.ask().text).to["max_width"], 0.0852);
}

// Wherever it is stopped there is no further plan.
TEST(Suggest, StoppedItEnds) {
    Fake fake = slippery(0.9);
    fake.request.approach_cones = {{Eigen::Vector3d::UnitX(), 0.2}};
    fake.miss("slips", 0.1);
    fake.miss("outside_approach_cones", 0.1);
    const std::uint64_t all = fake.ask().plans;
    ASSERT_GT(all, 4U);
    ASSERT_NE(fake.ask().text, "");
    for (fake.plans_allowed = 0; fake.plans_allowed < all; ++fake.plans_allowed) {
        EXPECT_THROW(fake.ask(), Stopped);
        EXPECT_EQ(fake.plans, fake.plans_allowed + 1);
    }
}

}  // namespace
}  // namespace graspd::planner_detail
