#include "graspd/base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace graspd {
namespace {

using Blocks = std::set<std::pair<std::size_t, std::size_t>>;

Blocks blocks_of(std::size_t count, std::size_t block) {
    Blocks blocks;
    std::mutex mutex;
    for_blocks(count, block, [&](std::size_t first, std::size_t last) {
        const std::scoped_lock lock(mutex);
        blocks.emplace(first, last);
    });
    return blocks;
}

TEST(ForBlocks, CutsAtMultiplesOfTheBlock) {
    EXPECT_EQ(blocks_of(10, 4), (Blocks{{0, 4}, {4, 8}, {8, 10}}));
    EXPECT_EQ(blocks_of(8, 4), (Blocks{{0, 4}, {4, 8}}));
    EXPECT_EQ(blocks_of(3, 4), (Blocks{{0, 3}}));
    EXPECT_EQ(blocks_of(0, 4), Blocks{});
}

TEST(ForBlocks, VisitsEveryPlaceOnce) {
    std::vector<int> visits(10007, 0);
    for_blocks(visits.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++visits[i];
    });
    EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
}

TEST(ForBlocks, HandsExceptionsOn) {
    const auto fail = [](std::size_t first, std::size_t) {
        if (first >= 64) throw std::runtime_error("second block");
    };
    EXPECT_THROW(for_blocks(1000, 64, fail), std::runtime_error);
}

TEST(RunTogether, RunsEveryPieceOnce) {
    std::vector<std::atomic<int>> runs(5);
    std::vector<std::function<void()>> work;
    for (std::atomic<int>& each : runs) work.emplace_back([&each] { ++each; });
    run_together(work);
    for (const std::atomic<int>& each : runs) EXPECT_EQ(each, 1);
}

}  // namespace
}  // namespace graspd
