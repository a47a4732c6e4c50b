#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace graspd::server {

/// Calls a function at once and then once a period, on a thread of its own, until it is stopped.
class Beat {
public:
    Beat(std::chrono::milliseconds period, std::function<void()> call)
        : thread_([period, call = std::move(call)](const std::stop_token& stop) {
              std::mutex mutex;
              std::condition_variable_any wake;
              std::unique_lock lock(mutex);
              while (!stop.stop_requested()) {
                  call();
                  wake.wait_for(lock, stop, period, [] { return false; });
              }
          }) {}

    /// Returns once no call is under way; none follows.
    void stop() {
        thread_.request_stop();
        if (thread_.joinable()) thread_.join();
    }

private:
    std::jthread thread_;
};

}  // namespace graspd::server
