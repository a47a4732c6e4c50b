#include "graspd/base/stop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "graspd/base/parallel.hpp"
#include "graspd/base/stoppable_sort.hpp"

namespace graspd {
namespace {

const StopQuery kStop = [] { return true; };
const StopQuery kGoOn = [] { return false; };

TEST(StopPoint, ThrowsWithinAScopeThatSaysSo) {
    EXPECT_NO_THROW(stop_point());
    {
        const StopScope scope(kGoOn);
        EXPECT_NO_THROW(stop_point());
        {
            const StopScope inner(kStop);
            EXPECT_THROW(stop_point(), Stopped);
            const StopScope shielded(nullptr);
            EXPECT_NO_THROW(stop_point());
        }
        EXPECT_NO_THROW(stop_point());
    }
    const StopQuery none;
    const StopScope empty(none);
    EXPECT_NO_THROW(stop_point());
}

TEST(StopPoint, OfALoopAsksEveryNowAndThen) {
    std::size_t asked = 0;
    const StopQuery count = [&] { return ++asked > 1000; };
    const StopScope scope(count);
    for (std::size_t i = 0; i < 10000; ++i) stop_point(i);
    EXPECT_GE(asked, 5U);
    EXPECT_LE(asked, 100U);
}

TEST(StopPoint, NamesTheInnermostStage) {
    const StopScope scope(kStop);
    const auto work = [] { as_stage("inner", [] { stop_point(); }); };
    try {
        as_stage("outer", work);
        FAIL() << "went on";
    } catch (const Stopped& stopped) {
        EXPECT_EQ(std::string(stopped.where), "inner");
    }
    EXPECT_EQ(as_stage("fine", [] { return 7; }), 7);
}

// The threads that help ask what the caller asks; a caller that does not stop is not stopped by
// another one's query, whichever thread does its work.
TEST(StopPoint, GoesAlongToOtherThreads) {
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> stop = false;
    const StopQuery query = [&] { return stop.load(); };
    const StopScope scope(query);
    const auto work = [&](std::size_t, std::size_t) {
        if (++done == 100) stop = true;
    };
    EXPECT_THROW(for_blocks(100000, 1, work), Stopped);
    EXPECT_GE(done, 100U);
    EXPECT_LT(done, 1000U);  // no thread begins another block
    EXPECT_THROW(run_together({[] {}}), Stopped);
    const StopScope shielded(nullptr);
    EXPECT_NO_THROW(for_blocks(1000, 1, [](std::size_t, std::size_t) { stop_point(); }));
}

TEST(StoppableSort, SortsAsTheStandardDoes) {
    std::mt19937_64 random(3);
    for (const std::size_t count : {0, 1, 1000, 32768, 32769, 100000, 200001}) {
        std::vector<std::uint64_t> items(count);
        for (std::uint64_t& item : items) item = random() % 100000;
        std::vector<std::uint64_t> expected = items;
        std::ranges::sort(expected, std::greater<>());
        stoppable_sort(items, std::greater<>());
        EXPECT_EQ(items, expected) << count;
    }
    std::vector<int> many(100000, 0);
    const StopScope scope(kStop);
    EXPECT_THROW(stoppable_sort(many), Stopped);
}

// An exception beside a loop must not end the loop as if it were done.
TEST(ForBlocks, AreAllDoneWhenTheyReturn) {
    for (int round = 0; round < 50; ++round) {
        const auto inner = [] {
            std::atomic<int> done = 0;
            for_blocks(64, 1, [&](std::size_t, std::size_t) { ++done; });
            EXPECT_EQ(done, 64);
        };
        const auto work = [&](std::size_t first, std::size_t) {
            if (first == 3) throw std::string("beside");
            inner();
        };
        EXPECT_THROW(for_blocks(16, 1, work), std::string);
    }
}

}  // namespace
}  // namespace graspd
