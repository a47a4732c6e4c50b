#include "graspd/base/freed_memory.hpp"

#include <algorithm>
#include <limits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace graspd {

void keep_freed_memory([[maybe_unused]] std::size_t bytes) {
#if defined(__GLIBC__)
    constexpr std::size_t kMostMapped = std::size_t{32} << 20;  // glibc accepts no more
    const auto as_int = [](std::size_t value) {
        constexpr std::size_t most = std::numeric_limits<int>::max();
        return static_cast<int>(std::min(value, most));
    };
    mallopt(M_TRIM_THRESHOLD, as_int(bytes));
    mallopt(M_MMAP_THRESHOLD, as_int(std::min(bytes, kMostMapped)));
#endif
}

void give_back_freed_memory() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

}  // namespace graspd
