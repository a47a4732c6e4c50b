#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace graspd::server {

/// Says once when the daemon has had nothing to do for some time after it had, so that memory kept
/// for the next plan goes back to the system.
class IdleWatch {
public:
    using Time = std::chrono::steady_clock::time_point;

    /// @param patience  zero: never
    explicit IdleWatch(std::chrono::milliseconds patience) : patience_(patience) {}

    /// To be told now and then. @param received  requests since the start. @param open  of them
    bool is_due(std::uint64_t received, std::size_t open, Time now) {
        if (received != received_ || open > 0) {
            received_ = received;
            busy_until_ = now;
            is_waiting_ = true;
        }
        const bool due = is_waiting_ && patience_.count() > 0 && now - busy_until_ >= patience_;
        if (due) is_waiting_ = false;
        return due;
    }

private:
    std::chrono::milliseconds patience_;
    std::uint64_t received_ = 0;
    Time busy_until_{};
    bool is_waiting_ = true;  ///< also for what the start took
};

}  // namespace graspd::server
