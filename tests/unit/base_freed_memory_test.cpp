#include "graspd/base/freed_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstddef>
#include <vector>

namespace graspd {
namespace {

long page_faults() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
}

/// Takes and gives back 16 MB so many times. @return page faults a time
long faults_per_round(int rounds) {
    constexpr std::size_t kBytes = std::size_t{16} << 20;
    const long before = page_faults();
    for (int i = 0; i < rounds; ++i) {
        const std::vector<char> block(kBytes, static_cast<char>(i));
        EXPECT_EQ(block.back(), static_cast<char>(i));
    }
    return (page_faults() - before) / rounds;
}

// 16 MB are 4096 pages of 4 kB; once they stay, none of them is mapped anew.
TEST(FreedMemory, StaysForWhatComesNext) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "another allocator";
#endif
    keep_freed_memory(0);  // as if all went back to the system at once
    EXPECT_GT(faults_per_round(10), 1000);
    keep_freed_memory(kFreedMemory_bytes);
    faults_per_round(1);
    EXPECT_LT(faults_per_round(10), 100);
}

}  // namespace
}  // namespace graspd
