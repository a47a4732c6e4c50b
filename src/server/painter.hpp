#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "planner_service.hpp"

namespace graspd::server {

/// What a painter is made of; both are called on its thread.
struct PainterParts {
    /// Draws and publishes. May throw; Stopped when told to stop by its thread's StopScope.
    std::function<void(const Answer&)> draw;
    /// Told why there is no picture.
    std::function<void(const Answer&, const std::string& what)> failed;
};

/// Draws plans after their replies, on a thread of its own, so that no reply waits for a picture.
/// Only the newest plan waits: a viewer shows one picture, and plans that come faster than they can
/// be drawn would otherwise pile up with their objects.
class Painter {
public:
    explicit Painter(PainterParts parts);
    /// As stop().
    ~Painter() { stop(); }
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// Takes the plan to be drawn, if the answer has one; returns at once. Any thread.
    void answered(const Answer& answer) noexcept;

    /// Tells the picture under way to stop, and returns once none is; none follows.
    void stop();

private:
    void run(const std::stop_token& stop);
    void draw(const Answer& answer, const std::stop_token& stop) noexcept;

    const PainterParts parts_;
    std::mutex mutex_;  ///< guards the next two
    std::condition_variable_any changed_;
    std::optional<Answer> waiting_;
    std::jthread thread_;  // last: ends before what it uses goes
};

}  // namespace graspd::server
