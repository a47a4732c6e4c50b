#include "planner_service.hpp"

#include <algorithm>
#include <limits>
#include <new>

#include "graspd/base/stop.hpp"
#include "make_reply.hpp"

namespace graspd::server {
namespace {

double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

ReplyCacheLimits cache_limits(const ServerConfig& config) {
    return {config.reply_cache_entries, config.reply_cache_bytes, config.queue_capacity};
}

}  // namespace

PlannerService::PlannerService(const ServerConfig& config, ServiceParts parts)
    : parts_(std::move(parts)),
      worker_count_(config.workers),
      most_abandoned_(config.abandoned_plans),
      abandon_after_(config.abandon_after_ms),
      max_memory_bytes_(config.max_memory_bytes),
      markers_(config.markers_when()),
      queue_(config.queue_capacity),
      outbox_(std::numeric_limits<std::size_t>::max()),
      objects_(config.object_cache_bytes),
      cache_(cache_limits(config)) {}

PlannerService::~PlannerService() {
    stop(std::chrono::seconds(1));
    alarms_.stop();
    for (const auto& worker : workers_) {  // while all that they use is there
        if (worker->thread.joinable()) worker->thread.join();
    }
}

void PlannerService::start() {
    const std::scoped_lock lock(mutex_);
    writing_ = true;
    writer_ = std::jthread([this] { write_replies(); });
    for (std::uint32_t i = 0; i < worker_count_; ++i) hire_locked();
}

void PlannerService::handle(std::unique_ptr<IncomingRequest> request) noexcept {
    try {
        receive(RequestPtr(std::move(request)));
    } catch (...) {  // no memory left for an answer either
        const std::scoped_lock lock(mutex_);
        ++counters_.lost;
    }
}

void PlannerService::receive(const RequestPtr& request) {
    const std::scoped_lock lock(mutex_);
    ++counters_.received;
    const ReplyCache::Admitted admitted = cache_.admit(request);
    const auto answer = [&](const PlanReply& reply) {
        send_locked({request, admitted.attempt, reply}, {});
    };
    switch (admitted.admission) {
        case Admission::kWait: return;
        case Admission::kAnswered: ++counters_.repeated; return answer(*admitted.reply);
        case Admission::kOverloaded: return answer(overloaded(*request));
        case Admission::kClash: return answer(id_clash(*request));
        case Admission::kPlan: break;
    }
    const auto alarm = alarms_.set(deadline_of(*request), [this, request] { expire(request); });
    open_.emplace(request, Open{std::make_shared<std::atomic<bool>>(false), alarm});
    if (const auto needed = needed_bytes(request->size()); needed > max_memory_bytes_) {
        return finish_locked(request, too_large(*request, needed, max_memory_bytes_), {});
    }
    RequestPtr item = request;
    if (queue_.try_push(item)) return;
    const bool stopping = stop_.stop_requested();
    finish_locked(request, stopping ? stopped(*request) : overloaded(*request), {});
}

void PlannerService::work(Worker& worker) {
    std::shared_ptr<Worker> self = worker.shared_from_this();
    bool goes_on = true;
    while (goes_on) {
        const auto request = queue_.pop();
        if (!request) break;
        const DropFlag dropped = begin(*request, self);
        if (dropped == nullptr) continue;
        Work done;
        const PlanReply reply = answer(**request, dropped, done);
        goes_on = end(self, reply, done);
    }
    self.reset();  // who destroys a worker waits for its thread
    const std::scoped_lock lock(mutex_);
    --running_;
    worker.ended = true;
    changed_.notify_all();
}

PlanReply PlannerService::answer(const IncomingRequest& request, const DropFlag& dropped,
                                 Work& work) {
    const auto deadline = deadline_of(request);
    const StopQuery stop_requested = [&] {
        return stop_.stop_requested() || *dropped || Clock::now() >= deadline;
    };
    const StopScope stoppable(stop_requested);
    try {
        return process(request, stop_requested, work);
    } catch (const Stopped&) {
        return stop_.stop_requested() ? stopped(request) : budget_spent(request);
    } catch (const std::bad_alloc&) {
        return internal_error(request, "out of memory (std::bad_alloc)");
    } catch (const std::exception& error) {
        return internal_error(request, error.what());
    } catch (...) {
        return internal_error(request, "something that is no std::exception");
    }
}

/// Converts and plans one request.
PlanReply PlannerService::process(const IncomingRequest& request, const StopQuery& stop_requested,
                                  Work& work) {
    work.queue_ms = ms_since(request.received());
    if (stop_.stop_requested()) return stopped(request);
    const auto start = Clock::now();
    auto converted = request.convert(parts_.grippers);
    work.convert_ms = ms_since(start);
    if (!converted.ok()) return refused(request, converted.error());
    PlanRequest problem = std::move(converted).value();
    if (problem.options.want_markers && markers_ == MarkersWhen::kNever) return no_markers(request);
    StoredObject object = known_object(request.object_key(), problem);
    const bool sent = request.object_key().empty();
    if (!sent && !object.geometry) return unknown_object(request);
    if (!sent) work.named_object = object.geometry;
    work.points = point_count(sent ? problem.object_O : *object.geometry);
    return plan_request(request, std::move(problem), std::move(object), stop_requested, work);
}

/// The object of an earlier request that this one names, or sends again.
StoredObject PlannerService::known_object(const std::string& key, const PlanRequest& problem) {
    if (!key.empty()) return objects_.find(key);
    return objects_.find(object_key_of(problem.object_O), problem.object_O);
}

PlanReply PlannerService::plan_request(const IncomingRequest& request, PlanRequest problem,
                                       StoredObject object, const StopQuery& stop_requested,
                                       Work& work) {
    if (Clock::now() >= deadline_of(request)) return budget_spent(request);
    const bool prepared = object.prepared != nullptr;
    if (!prepared && object.geometry) problem.object_O = *object.geometry;
    const auto start = Clock::now();
    PlanReply reply = parts_.plan(problem, object.prepared, stop_requested);
    work.plan_ms = ms_since(start);
    if (!prepared && !reply.object_key.empty()) {
        objects_.put(reply.object_key, std::move(problem.object_O), object.prepared);
    }
    work.drawable = drawable(problem, std::move(object.prepared), reply);
    if (reply.status != PlanStatus::kPartial) return reply;
    if (reply.grasps.empty() && stop_.stop_requested()) return stopped(request);
    if (Clock::now() >= deadline_of(request)) {
        reply.message = budget_text(request) + " is over: " + reply.message;
    }
    return reply;
}

/// What a picture of the plan needs; null where none is wanted, or the object is nothing to look
/// at.
std::shared_ptr<const PlanSubject> PlannerService::drawable(PlanRequest& problem,
                                                            PreparedObjectPtr object,
                                                            const PlanReply& reply) const {
    const bool wanted = markers_ == MarkersWhen::kAlways || problem.options.want_markers;
    const bool planned = reply.status == PlanStatus::kOk || reply.status == PlanStatus::kNoGrasp ||
                         reply.status == PlanStatus::kPartial;
    if (!wanted || !planned || object == nullptr) return nullptr;
    return std::make_shared<const PlanSubject>(
        PlanSubject{std::move(object), problem.X_FO, std::move(problem.grippers)});
}

void PlannerService::finish(const RequestPtr& request, const PlanReply& reply, const Work& work) {
    const std::scoped_lock lock(mutex_);
    finish_locked(request, reply, work);
}

/// Answers a request and the retries that wait for it, unless stop() was faster.
void PlannerService::finish_locked(const RequestPtr& request, const PlanReply& reply,
                                   const Work& work) {
    const auto at = open_.find(request);
    if (at == open_.end()) return;
    if (!at->second.begun) alarms_.forget(at->second.alarm);
    const auto answered = cache_.complete(request, reply);
    counters_.repeated += answered.size() - 1;
    Work done = work;
    for (const auto& [to, attempt] : answered) {
        send_locked({to, attempt, reply}, done);
        done.drawable = nullptr;  // once, however many retries are answered
    }
    open_.erase(request);
    changed_.notify_all();
}

void PlannerService::send_locked(OutgoingReply reply, const Work& work) {
    ++counters_.answers.at(static_cast<std::size_t>(reply.reply.status));
    Answer answer{std::move(reply), work};
    if (!outbox_.try_push(answer)) ++counters_.lost;  // closed: stop() has given up waiting
}

bool PlannerService::write(const OutgoingReply& reply) const noexcept {
    try {
        return parts_.write(reply);
    } catch (...) {
        return false;
    }
}

void PlannerService::write_replies() {
    while (auto answer = outbox_.pop()) {
        answer->written = write(answer->out);
        answer->total_ms = ms_since(answer->out.to->received());
        {
            const std::scoped_lock lock(mutex_);
            if (!answer->written) ++counters_.lost;
            if (answer->work.plan_ms > 0.0) latencies_.add(answer->total_ms);
        }
        if (parts_.log) parts_.log(*answer);
    }
    const std::scoped_lock lock(mutex_);
    writing_ = false;
    changed_.notify_all();
}

bool PlannerService::stop(std::chrono::milliseconds grace) {
    const auto start = Clock::now();
    stop_.request_stop();
    for (const RequestPtr& waiting : queue_.close_and_take()) {
        finish(waiting, stopped(*waiting), {});
    }
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, start + grace, [&] { return open_.empty() && running_ == 0; });
    while (!open_.empty()) {
        const RequestPtr late = open_.begin()->first;
        finish_locked(late, stopped(*late), {});
    }
    outbox_.close();
    changed_.wait_until(lock, start + 2 * grace, [&] { return !writing_; });
    counters_.lost += outbox_.close_and_take().size();
    return running_ == 0 && !writing_;
}

ServiceCounters PlannerService::counters() const {
    const std::scoped_lock lock(mutex_);
    ServiceCounters now = counters_;
    now.queued = queue_.size();
    now.open = open_.size();
    now.cached_objects = objects_.size();
    now.latency_p50_ms = latencies_.quantile_ms(0.5);
    now.latency_p95_ms = latencies_.quantile_ms(0.95);
    return now;
}

}  // namespace graspd::server
