#include "rejections.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace graspd::planner_detail {
namespace {

Eigen::Isometry3d at(double x) {
    return Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0));
}

std::string text_of(const std::vector<RejectionCount>& counts) {
    std::string text;
    for (const RejectionCount& row : counts) {
        text += row.reason + "=" + std::to_string(row.count) + " ";
    }
    return text;
}

TEST(Rejections, CountsComeMostFrequentFirstTiesByName) {
    Rejections rejections;
    EXPECT_TRUE(rejections.counts().empty());
    rejections.add("slips");
    rejections.add("palm_hits_object", 5);
    rejections.add("approach_hits_plane");
    rejections.add("slips", 2);
    rejections.add("no_contact");
    rejections.add("surplus", 0);  // nothing happened
    EXPECT_EQ(text_of(rejections.counts()),
              "palm_hits_object=5 slips=3 approach_hits_plane=1 no_contact=1 ");
    EXPECT_TRUE(rejections.misses().empty());
    EXPECT_EQ(rejections.count("slips"), 3U);
    EXPECT_EQ(rejections.count("surplus"), 0U);
}

// Margins are compared in units of their scale: 2 mm of 80 mm are nearer than 0.1 of 0.6.
TEST(Rejections, TheThreeNearestMissesStay) {
    Rejections rejections;
    rejections.add_miss("slips", at(1), 0.10, "1", 0.6);
    rejections.add_miss("too_wide", at(2), 0.002, "m", 0.08);
    rejections.add_miss("slips", at(3), 0.30, "1", 0.6);
    rejections.add_miss("too_wide", at(4), 0.004, "m", 0.08);
    rejections.add_miss("slips", at(5), 0.60, "1", 0.6);
    EXPECT_EQ(text_of(rejections.counts()), "slips=3 too_wide=2 ");
    const auto misses = rejections.misses();
    ASSERT_EQ(misses.size(), 3U);
    EXPECT_EQ(misses[0].X_FG.translation().x(), 2.0);
    EXPECT_EQ(misses[0].reason, "too_wide");
    EXPECT_EQ(misses[0].margin, 0.002);
    EXPECT_EQ(misses[0].unit, "m");
    EXPECT_EQ(misses[1].X_FG.translation().x(), 4.0);
    EXPECT_EQ(misses[2].X_FG.translation().x(), 1.0);
    EXPECT_EQ(misses[2].unit, "1");
}

TEST(Rejections, OfEqualMissesTheFirstStay) {
    Rejections rejections;
    for (int i = 0; i < 5; ++i) rejections.add_miss("slips", at(i), 0.1, "1", 1.0);
    const auto misses = rejections.misses();
    ASSERT_EQ(misses.size(), 3U);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(misses[i].X_FG.translation().x(), i);
}

TEST(Rejections, MergingAddsCountsAndKeepsTheNearest) {
    Rejections first, second;
    first.add("duplicate", 3);
    first.add_miss("slips", at(1), 0.4, "1", 1.0);
    first.add_miss("slips", at(2), 0.2, "1", 1.0);
    second.add("duplicate", 4);
    second.add_miss("clearance", at(3), 0.01, "m", 0.1);
    second.add_miss("clearance", at(4), 0.03, "m", 0.1);
    first.merge(second);
    EXPECT_EQ(text_of(first.counts()), "duplicate=7 clearance=2 slips=2 ");
    const auto misses = first.misses();
    ASSERT_EQ(misses.size(), 3U);
    EXPECT_EQ(misses[0].X_FG.translation().x(), 3.0);
    EXPECT_EQ(misses[1].X_FG.translation().x(), 2.0);
    EXPECT_EQ(misses[2].X_FG.translation().x(), 4.0);
}

// The least margin of a reason is known although three others' misses are nearer.
TEST(Rejections, TheLeastMarginOfEachReasonIsKept) {
    Rejections first, second;
    for (int i = 1; i <= 3; ++i) first.add_miss("slips", at(i), 0.01 * i, "1", 1.0);
    first.add_miss("too_wide", at(4), 0.3, "m", 0.1);
    first.add_miss("too_wide", at(5), 0.2, "m", 0.1);
    second.add_miss("too_wide", at(6), 0.25, "m", 0.1);
    second.add_miss("clearance", at(7), 0.5, "m", 0.1);
    second.add("palm_hits_object");
    first.merge(second);
    EXPECT_EQ(first.least_margin("slips"), 0.01);
    EXPECT_EQ(first.least_margin("too_wide"), 0.2);
    EXPECT_EQ(first.least_margin("clearance"), 0.5);
    EXPECT_EQ(first.least_margin("palm_hits_object"), std::nullopt);
    EXPECT_EQ(first.least_margin("no_contact"), std::nullopt);
}

}  // namespace
}  // namespace graspd::planner_detail
