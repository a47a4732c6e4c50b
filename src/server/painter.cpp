#include "painter.hpp"

#include <exception>
#include <utility>

#include "graspd/base/stop.hpp"

namespace graspd::server {

Painter::Painter(PainterParts parts)
    : parts_(std::move(parts)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Painter::answered(const Answer& answer) noexcept {
    if (answer.work.drawable == nullptr) return;
    try {
        std::optional<Answer> latest(answer);
        const std::scoped_lock lock(mutex_);
        waiting_.swap(latest);
        changed_.notify_one();
    } catch (const std::exception&) {  // out of memory: the picture before stays
    }
}

void Painter::stop() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
}

void Painter::run(const std::stop_token& stop) {
    while (true) {
        std::unique_lock lock(mutex_);
        if (!changed_.wait(lock, stop, [this] { return waiting_.has_value(); })) return;
        if (stop.stop_requested()) return;
        const Answer next = *std::exchange(waiting_, std::nullopt);
        lock.unlock();
        draw(next, stop);
    }
}

void Painter::draw(const Answer& answer, const std::stop_token& stop) noexcept {
    const StopQuery stopped = [&] { return stop.stop_requested(); };
    const StopScope stoppable(stopped);
    try {
        parts_.draw(answer);
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
        parts_.failed(answer, error.what());
    } catch (...) {
        parts_.failed(answer, "something that is no std::exception");
    }
}

}  // namespace graspd::server
