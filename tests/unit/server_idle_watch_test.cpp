#include "idle_watch.hpp"

#include <gtest/gtest.h>

namespace graspd::server {
namespace {

using namespace std::chrono_literals;

TEST(IdleWatch, IsDueOnceAfterEachWork) {
    const IdleWatch::Time start{1h};
    IdleWatch idle(5s);
    EXPECT_TRUE(idle.is_due(0, 0, start));  // what the start took
    EXPECT_FALSE(idle.is_due(0, 0, start + 10s));
    EXPECT_FALSE(idle.is_due(1, 1, start + 20s));
    EXPECT_FALSE(idle.is_due(1, 1, start + 30s));  // still planning
    EXPECT_FALSE(idle.is_due(1, 0, start + 34s));
    EXPECT_TRUE(idle.is_due(1, 0, start + 35s));
    EXPECT_FALSE(idle.is_due(1, 0, start + 60s));
    EXPECT_FALSE(idle.is_due(2, 0, start + 70s));  // came and went between two calls
    EXPECT_FALSE(idle.is_due(2, 0, start + 74s));
    EXPECT_TRUE(idle.is_due(2, 0, start + 75s));
}

TEST(IdleWatch, NeverWithoutPatience) {
    IdleWatch idle(0ms);
    EXPECT_FALSE(idle.is_due(0, 0, IdleWatch::Time{1h}));
    EXPECT_FALSE(idle.is_due(1, 0, IdleWatch::Time{2h}));
    EXPECT_FALSE(idle.is_due(1, 0, IdleWatch::Time{9h}));
}

}  // namespace
}  // namespace graspd::server
