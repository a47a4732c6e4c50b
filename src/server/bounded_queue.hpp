#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace graspd::server {

/// A queue between threads that never holds more than `capacity` items, so that a flood is refused
/// at its door instead of filling the memory. Every member may be called from any thread.
template <class T>
class BoundedQueue {
public:
    explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

    /// Takes the item at once or not at all, never waits.
    /// @return false when the queue is full or closed; the item is then the caller's still
    [[nodiscard]] bool try_push(T& item) {
        {
            const std::scoped_lock lock(mutex_);
            if (closed_ || items_.size() >= capacity_) return false;
            items_.push_back(std::move(item));
        }
        changed_.notify_one();
        return true;
    }

    /// Waits for an item, oldest first. @return nothing once the queue is closed and empty
    std::optional<T> pop() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return closed_ || !items_.empty(); });
        if (items_.empty()) return std::nullopt;
        std::optional<T> item(std::move(items_.front()));
        items_.pop_front();
        return item;
    }

    /// Takes an item out of turn, if it is still inside.
    void remove(const T& item) {
        const std::scoped_lock lock(mutex_);
        std::erase(items_, item);
    }

    /// Nothing is taken in from now on; what is inside can still be popped.
    void close() {
        {
            const std::scoped_lock lock(mutex_);
            closed_ = true;
        }
        changed_.notify_all();
    }

    /// Closes, and hands over what is inside, oldest first.
    std::deque<T> close_and_take() {
        std::deque<T> rest;
        {
            const std::scoped_lock lock(mutex_);
            closed_ = true;
            rest.swap(items_);
        }
        changed_.notify_all();
        return rest;
    }

    std::size_t size() const {
        const std::scoped_lock lock(mutex_);
        return items_.size();
    }

private:
    const std::size_t capacity_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<T> items_;
    bool closed_ = false;
};

}  // namespace graspd::server
