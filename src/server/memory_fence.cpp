#include "memory_fence.hpp"

#include <sys/resource.h>

namespace graspd::server {

bool fence_memory(std::uint64_t bytes) {
    if (bytes == 0) return true;
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0) return false;
    limit.rlim_cur = bytes;
    return ::setrlimit(RLIMIT_AS, &limit) == 0;
}

}  // namespace graspd::server
