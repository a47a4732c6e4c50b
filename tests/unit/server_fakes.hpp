#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graspd/dds/planner_port.hpp"

namespace graspd::server::test {

/// How long a test waits for something that must happen, before it fails: what is quick where
/// nothing else runs takes long under a sanitizer on a busy machine.
constexpr std::chrono::seconds kLimit{60};

/// A request without a middleware behind it.
struct FakeRequest : IncomingRequest {
    RequestIdentity id;
    std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now();
    std::string frame = "table";
    std::string key;
    PlanRequest problem;
    std::optional<PlanError> error;
    RequestSize counted;
    bool call = false;

    FakeRequest(std::uint8_t writer, const std::string& request_id, std::uint64_t hash = 7) {
        id.writer[0] = writer;
        id.request_id = request_id;
        id.payload_hash = hash;
        problem.request_id = request_id;
        problem.frame_id = frame;
        problem.object_O = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    }
    const RequestIdentity& identity() const override { return id; }
    std::chrono::steady_clock::time_point received() const override { return at; }
    const std::string& frame_id() const override { return frame; }
    const std::string& object_key() const override { return key; }
    double time_budget_s() const override { return problem.options.time_budget_s; }
    RequestSize size() const override { return counted; }
    bool is_call() const override { return call; }
    void take_over(std::chrono::steady_clock::time_point now) override { at = now; }
    Result<PlanRequest> convert(std::span<const Gripper>) const override {
        if (error) return *error;
        return problem;
    }
};

inline std::unique_ptr<FakeRequest> request(std::uint8_t writer, const std::string& id,
                                            std::uint64_t hash = 7) {
    return std::make_unique<FakeRequest>(writer, id, hash);
}

/// A value that threads set and others wait for.
template <class T>
class Watched {
public:
    template <class Change>
    void change(Change&& apply) {
        {
            const std::scoped_lock lock(mutex_);
            apply(value_);
        }
        changed_.notify_all();
    }
    /// @return whether the value came to satisfy the predicate within kLimit
    template <class Predicate>
    bool wait(Predicate&& holds) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, kLimit, [&] { return holds(std::as_const(value_)); });
    }
    T copy() const {
        const std::scoped_lock lock(mutex_);
        return value_;
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    T value_{};
};

}  // namespace graspd::server::test
