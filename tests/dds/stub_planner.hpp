#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "graspd/dds/planner_port.hpp"
#include "support/dds_domain.hpp"

namespace graspd::test {

using SharedRequest = std::shared_ptr<const IncomingRequest>;

/// A planner port whose requests are answered by a function on a thread of its own.
class StubPlanner {
public:
    /// Called for each request in turn; null: no answer.
    using Answer = std::function<std::unique_ptr<OutgoingReply>(const SharedRequest&)>;

    explicit StubPlanner(Answer answer, const DdsSettings& settings = loopback_settings())
        : answer_(std::move(answer)) {
        auto opened = PlannerPort::open(
            settings, [this](std::unique_ptr<IncomingRequest> r) { push(std::move(r)); });
        EXPECT_TRUE(opened.ok()) << opened.error().detail;
        if (!opened.ok()) return;
        port_ = std::move(opened).value();
        worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    }
    ~StubPlanner() {
        if (port_) port_->stop_listening();
    }

    PlannerPort& port() { return *port_; }

    /// Waits until so many requests have come, and returns all.
    std::vector<SharedRequest> wait_for(std::size_t count) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::seconds(10),
                          [&] { return received_.size() >= count; });
        return received_;
    }

private:
    void push(std::unique_ptr<IncomingRequest> request) {
        const std::lock_guard lock(mutex_);
        received_.emplace_back(std::move(request));
        queue_.push_back(received_.back());
        changed_.notify_all();
    }

    void work(const std::stop_token& stop) {
        while (true) {
            std::unique_lock lock(mutex_);
            if (!changed_.wait(lock, stop, [this] { return !queue_.empty(); })) return;
            const SharedRequest request = queue_.front();
            queue_.pop_front();
            lock.unlock();
            if (const auto reply = answer_(request)) port_->write(*reply);
        }
    }

    Answer answer_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<SharedRequest> queue_;
    std::vector<SharedRequest> received_;
    std::unique_ptr<PlannerPort> port_;
    std::jthread worker_;  // last: stops before the rest goes
};

/// A reply with a status and a message and nothing else.
inline std::unique_ptr<OutgoingReply> verdict(const SharedRequest& to, PlanStatus status,
                                              const std::string& message) {
    auto reply = std::make_unique<OutgoingReply>();
    reply->to = to;
    reply->reply.status = status;
    reply->reply.message = message;
    return reply;
}

/// What a StubPlanner may do with each request: say that there is no grasp, or nothing.
inline std::unique_ptr<OutgoingReply> no_grasp(const SharedRequest& request) {
    return verdict(request, PlanStatus::kNoGrasp, "none");
}
inline std::unique_ptr<OutgoingReply> no_answer(const SharedRequest&) {
    return nullptr;
}

}  // namespace graspd::test
