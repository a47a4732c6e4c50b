#pragma once

#include <sys/resource.h>

#include <chrono>

namespace graspd::bench {

/// [ms] of wall time.
inline double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

/// [MB] Most memory that this process has had.
inline double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace graspd::bench
