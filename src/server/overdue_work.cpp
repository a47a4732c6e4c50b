// The part of PlannerService that keeps its promise when the planner does not: the watchdog.
//
// A request's alarm rings when its budget is over. One that still waits is answered then. One that
// a worker has taken gets a little longer, in which its planner stops by itself; then it is
// answered for it, what the planner says later is dropped, and a new thread takes the worker's
// place. A planner that has not come back long after that is lost for good, and so are its thread
// and memory: too many of these, and the process asks to be started anew.

#include <exception>
#include <utility>

#include "make_reply.hpp"
#include "planner_service.hpp"

namespace graspd::server {
namespace {

// A planner stops within 50 ms of its budget or is answered for; the reply needs its time too.
constexpr std::chrono::milliseconds kPatience{40};

}  // namespace

/// The budget of a request that waits is over.
void PlannerService::expire(const RequestPtr& request) noexcept {
    const std::scoped_lock lock(mutex_);
    const auto at = open_.find(request);
    if (at == open_.end() || at->second.begun) return;
    queue_.remove(request);
    answer_late_locked(request);
}

void PlannerService::answer_late_locked(const RequestPtr& request) noexcept {
    try {
        finish_locked(request, budget_spent(*request), {});
    } catch (const std::exception&) {
        lose_locked(request);
    }
}

/// A worker begins with a request.
/// @return what tells its planner to stop; null when it has been answered, now or meanwhile
PlannerService::DropFlag PlannerService::begin(const RequestPtr& request,
                                               const std::shared_ptr<Worker>& worker) {
    const std::scoped_lock lock(mutex_);
    const auto at = open_.find(request);
    if (at == open_.end()) return nullptr;
    if (!stop_.stop_requested() && std::chrono::steady_clock::now() >= deadline_of(*request)) {
        answer_late_locked(request);  // before its alarm, which rings at this moment
        return nullptr;
    }
    alarms_.forget(at->second.alarm);
    at->second.begun = true;
    worker->job = request;
    worker->alarm = alarms_.set(deadline_of(*request) + kPatience,
                                [this, request, worker] { overrun(request, worker); });
    ++counters_.busy;
    return at->second.dropped;
}

/// A worker is done with its request, which may have been answered meanwhile.
/// @return whether it takes another one
bool PlannerService::end(const std::shared_ptr<Worker>& worker, const PlanReply& reply,
                         const Work& work) noexcept {
    const std::scoped_lock lock(mutex_);
    const RequestPtr request = std::exchange(worker->job, nullptr);
    alarms_.forget(worker->alarm);
    if (!worker->replaced) --counters_.busy;
    try {
        finish_locked(request, reply, work);
    } catch (const std::exception&) {
        lose_locked(request);
    }
    return !worker->replaced;
}

/// The budget of a request is over, and its planner has not stopped.
void PlannerService::overrun(const RequestPtr& request,
                             const std::shared_ptr<Worker>& worker) noexcept {
    const std::scoped_lock lock(mutex_);
    try {
        if (worker->job != request) return;
        worker->replaced = true;
        --counters_.busy;
        worker->alarm = alarms_.set(std::chrono::steady_clock::now() + abandon_after_,
                                    [this, request, worker] { abandon(request, worker); });
        if (!stop_.stop_requested()) hire_locked();
        finish_locked(request, overran(*request), {});
    } catch (const std::exception&) {
        lose_locked(request);
    }
}

/// A planner has not stopped long after its budget.
void PlannerService::abandon(const RequestPtr& request,
                             const std::shared_ptr<Worker>& worker) noexcept {
    bool is_last = false;
    {
        const std::scoped_lock lock(mutex_);
        if (worker->job != request) return;
        ++counters_.abandoned_plans;
        is_last = counters_.abandoned_plans == most_abandoned_;
    }
    if (is_last && parts_.exhausted) parts_.exhausted();
}

/// A request that not even an answer could be found for.
void PlannerService::lose_locked(const RequestPtr& request) noexcept {
    ++counters_.lost;
    open_.erase(request);
    changed_.notify_all();
}

/// Starts a worker's thread, and clears away those that have ended.
void PlannerService::hire_locked() {
    std::erase_if(workers_, [](const auto& worker) { return worker->ended; });
    const auto& worker = workers_.emplace_back(std::make_shared<Worker>());
    try {
        worker->thread = std::jthread([this, raw = worker.get()] { work(*raw); });
        ++running_;
    } catch (const std::exception&) {  // no thread to be had: fewer workers are better than none
        workers_.pop_back();
    }
}

}  // namespace graspd::server
