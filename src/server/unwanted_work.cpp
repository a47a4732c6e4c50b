// The part of PlannerService that gives up requests which nobody wants from it any more: cancelled,
// of callers that have gone, or left to other planners.

#include <vector>

#include "make_reply.hpp"
#include "planner_service.hpp"

namespace graspd::server {

std::size_t PlannerService::cancel(const CancelOrder& order) {
    return cancel_those([&](const IncomingRequest& request) {
        const RequestIdentity& identity = request.identity();
        const bool every = order.request_id.empty();
        return identity.client_id == order.client_id &&
               (every || identity.request_id == order.request_id);
    });
}

std::size_t PlannerService::drop(const GuidBytes& writer) {
    const std::size_t count = cancel_those([&](const IncomingRequest& request) {
        return request.is_call() && request.identity().writer == writer;
    });
    const std::scoped_lock lock(mutex_);
    counters_.dropped += count;
    return count;
}

/// Answers CANCELLED to the chosen of the open requests, and tells their planners to stop.
template <class Chosen>
std::size_t PlannerService::cancel_those(Chosen&& chosen) {
    const std::scoped_lock lock(mutex_);
    std::vector<RequestPtr> named;
    for (const auto& [request, open] : open_) {
        if (chosen(*request)) named.push_back(request);
    }
    for (const RequestPtr& request : named) {
        *open_.at(request).dropped = true;
        queue_.remove(request);
        finish_locked(request, cancelled(*request), {});
    }
    return named.size();
}

std::size_t PlannerService::hand_over() {
    const std::scoped_lock lock(mutex_);
    const std::size_t count = open_.size();
    for (const auto& [request, open] : open_) {
        *open.dropped = true;
        queue_.remove(request);
        if (!open.begun) alarms_.forget(open.alarm);
    }
    open_.clear();
    changed_.notify_all();
    return count;
}

}  // namespace graspd::server
