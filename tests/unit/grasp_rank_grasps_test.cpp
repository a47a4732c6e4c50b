#include "graspd/grasp/rank_grasps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace graspd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Order = std::vector<std::size_t>;

constexpr double kPi = std::numbers::pi;

Matrix3d turned(double angle_rad, const Vector3d& axis) {
    return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

RankedEntry entry(double score, double x_m, std::int32_t concavity = -1,
                  const Matrix3d& turn = Matrix3d::Identity()) {
    RankedEntry e;
    e.score = score;
    e.concavity = concavity;
    e.X_WG.translation() << x_m, 0, 0;
    e.X_WG.linear() = turn;
    return e;
}
Ranking ranked(const std::vector<RankedEntry>& entries, std::uint32_t max_grasps = 100,
               const RankGraspsConfig& config = {}) {
    const auto ranking = rank_grasps(entries, max_grasps, config);
    EXPECT_TRUE(ranking.ok()) << (ranking.ok() ? "" : ranking.error().detail);
    return ranking.ok() ? ranking.value() : Ranking{};
}

// A metre apart none is like another.
TEST(RankGrasps, ByFallingScoreTiesByIndex) {
    const Ranking ranking =
        ranked({entry(0.2, 0), entry(0.9, 1), entry(0.5, 2), entry(0.9, 3), entry(0.5, 4)});
    EXPECT_EQ(ranking.order, (Order{1, 3, 2, 4, 0}));
    EXPECT_EQ(ranking.duplicates.size(), 0U);
    EXPECT_EQ(ranking.surplus.size(), 0U);
    EXPECT_TRUE(ranked({}).order.empty());
}

// The same within half a finger's width, 10, and 0.26 rad: both limits must hold.
TEST(RankGrasps, TheBetterOneStandsForItsLike) {
    const Vector3d axis(1, 2, 3);
    const std::vector<RankedEntry> entries = {
        entry(0.5, 0.0099), entry(0.9, 0.0), entry(0.8, 0.0101),
        entry(0.7, 0.0, -1, turned(0.25, axis)), entry(0.6, 0.0, -1, turned(0.27, axis))};
    const Ranking ranking = ranked(entries);
    // 0 and 3 are like 1. 2 is 10.1 from 1, and 4 is turned too far from it and too far from 2.
    EXPECT_EQ(ranking.order, (Order{1, 2, 4}));
    EXPECT_EQ(ranking.duplicates.size(), 2U);
    RankGraspsConfig strict;
    strict.same_distance_finger_widths = 0.0;
    strict.same_angle_rad = 0.0;
    EXPECT_EQ(ranked(entries, 100, strict).order.size(), 5U);
}

// Of two grippers the wider finger says what is near.
TEST(RankGrasps, TheWiderFingerSaysWhatIsNear) {
    std::vector<RankedEntry> entries = {entry(0.9, 0), entry(0.5, 0.015)};
    EXPECT_EQ(ranked(entries).order.size(), 2U);
    entries[0].finger_width_m = 0.04;
    EXPECT_EQ(ranked(entries).order.size(), 1U);
    std::swap(entries[0].finger_width_m, entries[1].finger_width_m);
    EXPECT_EQ(ranked(entries).order.size(), 1U);
}

// With the fingers swapped it is the same grasp; upside down or turned by a quarter it is not.
TEST(RankGrasps, HalfATurnAboutTheApproachIsTheSame) {
    const Vector3d z = Vector3d::UnitZ(), x = Vector3d::UnitX();
    const Matrix3d skew = turned(1.0, {1, -2, 0.5});
    const std::vector<RankedEntry> entries = {
        entry(0.9, 0, -1, skew), entry(0.8, 0, -1, skew * turned(kPi, z)),
        entry(0.7, 0, -1, skew * turned(kPi, x)), entry(0.6, 0, -1, skew * turned(kPi / 2, z)),
        entry(0.5, 0, -1, skew * turned(kPi + 0.25, z))};
    const Ranking ranking = ranked(entries);
    EXPECT_EQ(ranking.order, (Order{0, 2, 3}));
    EXPECT_EQ(ranking.duplicates.size(), 2U);
}

TEST(GraspAngle, IsThatOfTheRotationUpToSwappedFingers) {
    const Matrix3d base = turned(0.8, {3, 1, -2});
    const Vector3d z = Vector3d::UnitZ();
    for (const double angle : {0.0, 0.01, 0.3, 1.0, 1.5}) {
        EXPECT_NEAR(grasp_angle_rad(base, base * turned(angle, z)), angle, 1e-6);
        EXPECT_NEAR(grasp_angle_rad(base, base * turned(kPi - angle, z)), angle, 1e-6);
        EXPECT_NEAR(grasp_angle_rad(base, base * turned(angle, {1, 0, 0})), angle, 1e-6);
        EXPECT_NEAR(grasp_angle_rad(base * turned(kPi, z), base * turned(angle, {0, 1, 0})), angle,
                    1e-6);
    }
    EXPECT_NEAR(grasp_angle_rad(base, base * turned(kPi, {1, 0, 0})), kPi, 1e-6);
}

// Regions 0 and 1, and one entry (0.4) of none: with room for two or three the best of either
// region, and the rest of the room for the best. Their order stays that of the scores.
TEST(RankGrasps, TheBestOfEachConcavitySurvivesTheCut) {
    const std::vector<RankedEntry> entries = {entry(0.9, 0, 0), entry(0.8, 1, 0), entry(0.7, 2, 0),
                                              entry(0.6, 3, 0), entry(0.3, 4, 1), entry(0.2, 5, 1),
                                              entry(0.4, 6, -1)};
    const RankGraspsConfig config{.likely_score = 0.25};
    const Ranking two = ranked(entries, 2, config);
    EXPECT_EQ(two.order, (Order{0, 4}));
    EXPECT_EQ(two.surplus.size(), 5U);
    EXPECT_EQ(ranked(entries, 3, config).order, (Order{0, 1, 4}));
    EXPECT_EQ(ranked(entries, 6, config).order, (Order{0, 1, 2, 3, 6, 4}));
    const Ranking all = ranked(entries, 7, config);
    EXPECT_EQ(all.order, (Order{0, 1, 2, 3, 6, 4, 5}));
    EXPECT_EQ(all.surplus.size(), 0U);
}

// A region's best of 0.3 takes no place from a better one when only 0.5 is likely to hold.
TEST(RankGrasps, TheBestOfAConcavityIsCutWhenItIsUnlikelyToHold) {
    const std::vector<RankedEntry> entries = {entry(0.9, 0, 0), entry(0.8, 1, 0), entry(0.3, 2, 1)};
    EXPECT_EQ(ranked(entries, 2, {.likely_score = 0.5}).order, (Order{0, 1}));
    EXPECT_EQ(ranked(entries, 2, {.likely_score = 0.3}).order, (Order{0, 2}));
}

// With room for two of three regions the better two.
TEST(RankGrasps, WithTooManyConcavitiesTheBetterOnesStay) {
    const Ranking ranking = ranked({entry(0.3, 0, 0), entry(0.9, 1, 1), entry(0.6, 2, 2)}, 2);
    EXPECT_EQ(ranking.order, (Order{1, 2}));
    EXPECT_EQ(ranking.surplus.size(), 1U);
    EXPECT_EQ(ranked({entry(0.3, 0, 0), entry(0.9, 1, 1)}, 1).order, (Order{1}));
}

// Every entry is kept, a duplicate or surplus.
TEST(RankGrasps, NothingGetsLost) {
    std::vector<RankedEntry> entries;
    for (int i = 0; i < 60; ++i) {
        entries.push_back(entry(0.1 + 0.013 * ((i * 37) % 61), 0.004 * (i % 20), i % 4 - 1));
    }
    for (const std::uint32_t most : {1U, 3U, 5U, 50U}) {
        const Ranking ranking = ranked(entries, most);
        EXPECT_LE(ranking.order.size(), most);
        std::vector<std::size_t> all = ranking.order;
        all.insert(all.end(), ranking.duplicates.begin(), ranking.duplicates.end());
        all.insert(all.end(), ranking.surplus.begin(), ranking.surplus.end());
        std::ranges::sort(all);
        ASSERT_EQ(all.size(), entries.size());
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
        for (std::size_t i = 0; i + 1 < ranking.order.size(); ++i) {
            EXPECT_GE(entries[ranking.order[i]].score, entries[ranking.order[i + 1]].score);
        }
    }
}

TEST(RankGrasps, EveryErrorNamesItsCause) {
    const auto expect = [](const std::vector<RankedEntry>& entries, std::uint32_t most,
                           const RankGraspsConfig& config, const char* name) {
        const auto ranking = rank_grasps(entries, most, config);
        ASSERT_FALSE(ranking.ok()) << name;
        EXPECT_EQ(ranking.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_NE(ranking.error().detail.find(name), std::string::npos) << ranking.error().detail;
    };
    const std::vector<RankedEntry> one = {entry(0.5, 0)};
    expect(one, 0, {}, "max_grasps = 0");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    expect({entry(0.5, 0), entry(nan, 1)}, 3, {}, "score[1]");
    expect({entry(infinity, 1)}, 3, {}, "score[0]");
    expect(one, 3, {.same_distance_finger_widths = -0.1}, "same_distance_finger_widths");
    expect(one, 3, {.same_angle_rad = 3.3}, "same_angle_rad");
}

}  // namespace
}  // namespace graspd
