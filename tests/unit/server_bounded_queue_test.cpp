#include "bounded_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <vector>

namespace graspd::server {
namespace {

TEST(BoundedQueue, RefusesWhatExceedsItsCapacityAndLeavesItToTheCaller) {
    BoundedQueue<std::unique_ptr<int>> queue(2);
    for (int i = 0; i < 2; ++i) {
        auto item = std::make_unique<int>(i);
        EXPECT_TRUE(queue.try_push(item));
    }
    auto third = std::make_unique<int>(2);
    EXPECT_FALSE(queue.try_push(third));
    ASSERT_NE(third, nullptr);
    EXPECT_EQ(queue.size(), 2u);
    EXPECT_EQ(**queue.pop(), 0);  // oldest first
    EXPECT_TRUE(queue.try_push(third));
    EXPECT_EQ(**queue.pop(), 1);
    EXPECT_EQ(**queue.pop(), 2);
}

TEST(BoundedQueue, ClosedItTakesNothingAndGivesWhatItHas) {
    BoundedQueue<int> queue(4);
    int item = 5;
    ASSERT_TRUE(queue.try_push(item));
    queue.close();
    EXPECT_FALSE(queue.try_push(item));
    EXPECT_EQ(queue.pop(), 5);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, CloseAndTakeHandsOverTheRest) {
    BoundedQueue<int> queue(4);
    for (int i = 0; i < 3; ++i) {
        int item = i;
        ASSERT_TRUE(queue.try_push(item));
    }
    EXPECT_EQ(queue.close_and_take(), (std::deque<int>{0, 1, 2}));
    EXPECT_EQ(queue.pop(), std::nullopt);
    int late = 9;
    EXPECT_FALSE(queue.try_push(late));
}

// Threads that wait in pop() would hang the join below if close() woke only one of them.
TEST(BoundedQueue, CloseWakesEveryWaitingThread) {
    BoundedQueue<int> queue(4);
    std::vector<std::jthread> waiting;
    for (int i = 0; i < 3; ++i) waiting.emplace_back([&] { EXPECT_FALSE(queue.pop()); });
    queue.close();
}

// 4 writers, 3 readers: every number arrives once. A writer whose item is refused tries again.
TEST(BoundedQueue, NothingIsLostOrDoubledBetweenThreads) {
    constexpr int kEach = 2000;
    BoundedQueue<int> queue(8);
    std::vector<std::vector<int>> got(3);
    {
        std::vector<std::jthread> readers;
        for (auto& mine : got) {
            readers.emplace_back([&queue, &mine] {
                while (const auto item = queue.pop()) mine.push_back(*item);
            });
        }
        {
            std::vector<std::jthread> writers;
            for (int w = 0; w < 4; ++w) {
                writers.emplace_back([&queue, w] {
                    for (int i = 0; i < kEach; ++i) {
                        int item = w * kEach + i;
                        while (!queue.try_push(item)) std::this_thread::yield();
                    }
                });
            }
        }
        queue.close();
    }
    std::vector<int> all;
    for (const auto& mine : got) all.insert(all.end(), mine.begin(), mine.end());
    std::ranges::sort(all);
    ASSERT_EQ(all.size(), 4u * kEach);
    for (int i = 0; i < 4 * kEach; ++i) ASSERT_EQ(all[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace graspd::server
