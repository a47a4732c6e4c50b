#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace graspd::server {

/// The latencies of the last 256 requests, for medians and tails. Not thread-safe: its owner locks.
class LatencyWindow {
public:
    void add(double ms) {
        recent_ms_[next_] = ms;
        next_ = (next_ + 1) % recent_ms_.size();
        count_ = std::min(count_ + 1, recent_ms_.size());
    }

    /// The latency [ms] that the share `q` in (0, 1] of them stays at or below; 0 without any.
    double quantile_ms(double q) const {
        if (count_ == 0) return 0.0;
        auto sorted = recent_ms_;
        const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count_);
        const auto rank = static_cast<std::ptrdiff_t>(std::ceil(q * static_cast<double>(count_)));
        const auto at = sorted.begin() + std::max<std::ptrdiff_t>(rank - 1, 0);
        std::nth_element(sorted.begin(), at, end);
        return *at;
    }

private:
    std::array<double, 256> recent_ms_{};
    std::size_t next_ = 0;
    std::size_t count_ = 0;
};

}  // namespace graspd::server
