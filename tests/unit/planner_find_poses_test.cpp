#include "find_poses.hpp"

#include <gtest/gtest.h>

namespace graspd::planner_detail {
namespace {

TEST(FindPoses, AStepBackLeavesSomeOfTheTips) {
    const SearchConfig search;  // 0.8 tip offsets, 4 mm at the least
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.035), 0.028);
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.010), 0.006);  // not 8: 2 would be left
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.006), 0.003);  // half, where 4 is most of it
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.0), 0.0);
}

TEST(FindPoses, StepsAreSettings) {
    SearchConfig search;
    search.insertion_tip_offsets = 0.5;
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.02), 0.01);
    search.insertion_least_tip_m = 0.012;
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.02), 0.01);  // no less than half
    search.insertion_tip_offsets = 1.0;
    search.insertion_least_tip_m = 0.0;
    EXPECT_DOUBLE_EQ(insertion_step_m(search, 0.02), 0.02);
}

TEST(FindPoses, TheFirstTurnsAreFarApart) {
    using Turns = std::vector<std::uint32_t>;
    EXPECT_EQ(spread_turns(8), (Turns{0, 4, 2, 6, 1, 5, 3, 7}));
    EXPECT_EQ(spread_turns(6), (Turns{0, 4, 2, 1, 5, 3}));
    EXPECT_EQ(spread_turns(2), (Turns{0, 1}));
    EXPECT_EQ(spread_turns(1), (Turns{0}));
}

}  // namespace
}  // namespace graspd::planner_detail
