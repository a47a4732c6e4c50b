#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace graspd::server {

/// Calls functions at their times, one after the other, on a thread of its own. They must not throw
/// nor take long. Every member may be called from any thread, also from such a function and after
/// stop(); an alarm that is set then never comes.
class AlarmClock {
public:
    using Time = std::chrono::steady_clock::time_point;
    using Id = std::pair<Time, std::uint64_t>;  ///< in the order of the calls

    AlarmClock();

    Id set(Time when, std::function<void()> call);
    /// The function is not called any more, unless its call is under way.
    void forget(const Id& id);
    /// Returns once no call is under way; none follows. Not for the functions.
    void stop();

private:
    void run(const std::stop_token& stop);

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::map<Id, std::function<void()>> calls_;
    std::uint64_t count_ = 0;
    std::jthread thread_;  // last: it uses the rest
};

}  // namespace graspd::server
