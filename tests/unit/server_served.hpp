#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "planner_service.hpp"
#include "server_fakes.hpp"

namespace graspd::server::test {

inline PlanReply reply_to(const PlanRequest& problem, PlanStatus status) {
    PlanReply reply;
    reply.request_id = problem.request_id;
    reply.frame_id = problem.frame_id;
    reply.status = status;
    return reply;
}

inline PlanReply plan_at_once(const PlanRequest& problem, const StopQuery&) {
    return reply_to(problem, PlanStatus::kOk);
}

/// A planner that works until it is let go or told to stop, and counts its calls.
class SlowPlanner {
public:
    PlanReply operator()(const PlanRequest& problem, const StopQuery& stop_requested) {
        calls_.change([](int& calls) { ++calls; });
        while (!released_.copy() && !stop_requested()) std::this_thread::yield();
        return reply_to(problem, released_.copy() ? PlanStatus::kOk : PlanStatus::kPartial);
    }
    bool wait_for_calls(int n) {
        return calls_.wait([&](int calls) { return calls >= n; });
    }
    void release() {
        released_.change([](bool& released) { released = true; });
    }
    int calls() const { return calls_.copy(); }

private:
    Watched<int> calls_;
    Watched<bool> released_;
};

/// A planner that takes no notice of prepared objects.
using PlainPlan = std::function<PlanReply(const PlanRequest&, const StopQuery&)>;
inline decltype(ServiceParts::plan) without_objects(PlainPlan plan) {
    return [plan = std::move(plan)](const PlanRequest& problem, PreparedObjectPtr&,
                                    const StopQuery& stop) { return plan(problem, stop); };
}

/// A service whose replies end up in a list.
class Served {
public:
    explicit Served(PlainPlan plan, ServerConfig config = one_worker(4))
        : Served(without_objects(std::move(plan)), config) {}
    explicit Served(decltype(ServiceParts::plan) plan, ServerConfig config = one_worker(4))
        : service(config,
                  {{}, std::move(plan), [this](const auto& out) { return take(out); }, {}}) {
        service.start();
    }
    static ServerConfig one_worker(std::uint32_t queue_capacity) {
        ServerConfig config;
        config.workers = 1;
        config.queue_capacity = queue_capacity;
        return config;
    }
    bool wait_for(std::size_t n) {
        return written.wait([&](const auto& list) { return list.size() >= n; });
    }
    std::vector<PlanStatus> statuses() const {
        std::vector<PlanStatus> list;
        for (const OutgoingReply& out : written.copy()) list.push_back(out.reply.status);
        return list;
    }

private:
    bool take(const OutgoingReply& out) {
        written.change([&](auto& list) { list.push_back(out); });
        return true;
    }

public:
    Watched<std::vector<OutgoingReply>> written;
    PlannerService service;  // last: its threads use the list
};

}  // namespace graspd::server::test
