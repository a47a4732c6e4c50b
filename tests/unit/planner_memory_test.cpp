// What a prepared object says that it takes, against what the heap says: every operator new and
// delete of this program counts. A program of its own for that.

#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "graspd/planner/prepared_object.hpp"
#include "support/shapes.hpp"

namespace {

std::atomic<std::int64_t> live_bytes{0};
std::atomic<std::int64_t> live_blocks{0};

void* counted(void* block) {
    if (block == nullptr) throw std::bad_alloc();
    live_bytes += static_cast<std::int64_t>(::malloc_usable_size(block));
    ++live_blocks;
    return block;
}
void release(void* block) {
    if (block == nullptr) return;
    live_bytes -= static_cast<std::int64_t>(::malloc_usable_size(block));
    --live_blocks;
    std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
    return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto align = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* block) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t) noexcept {
    release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
    release(block);
}

namespace graspd {
namespace {

void expect_counted(const TriangleMesh& mesh, const PlannerConfig& config) {
    ASSERT_TRUE(prepare(mesh, config).ok());  // what is made once in a process is made here
    const std::int64_t bytes_before = live_bytes, blocks_before = live_blocks;
    const PreparedObjectPtr object = prepare(mesh, config).value();
    const std::int64_t blocks = live_blocks - blocks_before;
    const std::int64_t bytes = live_bytes - bytes_before;
    const auto said = static_cast<std::int64_t>(memory_bytes(*object));
    EXPECT_GT(blocks, 10);
    EXPECT_LT(blocks, 100);
    // The heap rounds a block up by 24 bytes at most; the handles have a block of their own.
    EXPECT_LE(said, bytes);
    EXPECT_GE(said, bytes - 24 * blocks - 100);
}

TEST(PreparedObject, CountsItsMemoryToTheByte) {
    expect_counted(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 4000), {});
    expect_counted(test::torus(0.05, 0.015, 3000), {});
}

TEST(PreparedObject, CountsTheBendsOfItsWays) {
    PlannerConfig config;
    config.search.exact_concavity = true;
    expect_counted(test::box_hourglass({0.06, 0.048, 0.01}, 0.02, 0.03, 4000), config);
}

// A hole to fill, a face twice: findings with texts.
TEST(PreparedObject, CountsItsFindings) {
    TriangleMesh mesh = test::box({0.06, 0.04, 0.02}, 300);
    mesh.faces.erase(mesh.faces.begin() + 7);
    mesh.faces.push_back(mesh.faces.front());
    expect_counted(mesh, {});
}

}  // namespace
}  // namespace graspd
