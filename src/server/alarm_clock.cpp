#include "alarm_clock.hpp"

namespace graspd::server {

AlarmClock::AlarmClock() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

AlarmClock::Id AlarmClock::set(Time when, std::function<void()> call) {
    const std::scoped_lock lock(mutex_);
    const Id id{when, ++count_};
    const auto at = calls_.emplace(id, std::move(call)).first;
    if (at == calls_.begin()) changed_.notify_all();
    return id;
}

void AlarmClock::forget(const Id& id) {
    const std::scoped_lock lock(mutex_);
    calls_.erase(id);
}

void AlarmClock::stop() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
}

void AlarmClock::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        if (calls_.empty()) {
            changed_.wait(lock, stop, [this] { return !calls_.empty(); });
            continue;
        }
        const Time next = calls_.begin()->first.first;
        if (std::chrono::steady_clock::now() < next) {
            changed_.wait_until(lock, stop, next, [&] {
                return calls_.empty() || calls_.begin()->first.first != next;
            });
            continue;
        }
        const auto due = calls_.extract(calls_.begin());
        lock.unlock();
        due.mapped()();
        lock.lock();
    }
}

}  // namespace graspd::server
