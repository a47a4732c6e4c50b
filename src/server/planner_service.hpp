#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <unordered_map>
#include <vector>

#include "alarm_clock.hpp"
#include "bounded_queue.hpp"
#include "graspd/dds/planner_port.hpp"
#include "graspd/planner/draw_plan.hpp"
#include "graspd/planner/planner.hpp"
#include "latency_window.hpp"
#include "object_store.hpp"
#include "reply_cache.hpp"
#include "server_config.hpp"

namespace graspd::server {

/// What the worker did for a request, for whoever is told of its answer.
struct Work {
    std::size_t points = 0;   ///< vertices or cloud points of the object
    double queue_ms = 0.0;    ///< [ms] from receipt until a worker took it
    double convert_ms = 0.0;  ///< [ms] checking and converting
    double plan_ms = 0.0;     ///< [ms] in the planner
    std::shared_ptr<const ObjectGeometry> named_object = {};  ///< of a request with an object_key
    std::shared_ptr<const PlanSubject> drawable = {};  ///< null: this plan is not to be drawn
};

/// A reply on its way out, or just written.
struct Answer {
    OutgoingReply out;
    Work work;            ///< zeros for an answer that needed no worker
    double total_ms = 0;  ///< [ms] from receipt until it was written
    bool written = false;
};

/// What the service is made of; all of it may be replaced in tests.
struct ServiceParts {
    std::vector<Gripper> grippers;  ///< those that a request may name
    /// On many threads. The object: as plan() takes it, null where it is not known yet.
    std::function<PlanReply(const PlanRequest&, PreparedObjectPtr&, const StopQuery&)> plan;
    std::function<bool(const OutgoingReply&)> write;  ///< on one thread; false: lost
    std::function<void(const Answer&)> log;           ///< likewise, after the write; may be empty
    /// Called once, on any thread, when as many plans were abandoned as are allowed; may be empty.
    std::function<void()> exhausted = {};
};

/// A snapshot of what the service has done and has to do.
struct ServiceCounters {
    std::uint64_t received = 0;
    std::array<std::uint64_t, 9> answers{};  ///< by PlanStatus
    std::uint64_t repeated = 0;              ///< answers that came from the reply cache
    std::uint64_t lost = 0;                  ///< answers that could not be written
    std::uint64_t abandoned_plans = 0;       ///< whose planner did not stop long after its budget
    std::uint64_t dropped = 0;               ///< service calls whose caller had gone
    std::size_t queued = 0;                  ///< waiting for a worker
    std::size_t open = 0;                    ///< waiting or being planned
    std::size_t busy = 0;                    ///< workers that plan or convert
    std::size_t cached_objects = 0;          ///< kept under their object_key
    double latency_p50_ms = 0.0;             ///< [ms] receipt to reply, of the last 256 plans
    double latency_p95_ms = 0.0;             ///< [ms]
};

/// Takes requests and answers each of them exactly once, whatever happens.
///
///     handle() -> bounded queue -> workers: convert, plan -> outbox -> one writer thread
///
/// A request that finds the queue full is answered OVERLOADED at once; a retry gets the reply that
/// its first sending got; an exception becomes INTERNAL_ERROR. A request's time budget counts from
/// receipt, and its answer comes within 50 ms of it, whatever the planner does (overdue_work.cpp).
/// A cancelled request is answered CANCELLED at once, and its planner told to stop.
/// Replies do not depend on the number of workers.
class PlannerService {
public:
    PlannerService(const ServerConfig& config, ServiceParts parts);
    /// Stops; waits for planners that do not listen to their StopQuery.
    ~PlannerService();
    PlannerService(const PlannerService&) = delete;
    PlannerService& operator=(const PlannerService&) = delete;

    /// Starts the threads. Requests may come before: they wait in the queue.
    void start();

    /// Takes over a request; returns at once, never throws. Any thread.
    void handle(std::unique_ptr<IncomingRequest> request) noexcept;

    /// Answers CANCELLED to every open request that the order names. Any thread.
    /// @return how many there were
    std::size_t cancel(const CancelOrder& order);

    /// Answers CANCELLED to every open service call of a writer that has gone: nobody but its
    /// caller can read the answer. A request by the topic is planned all the same, for any reader
    /// may wait for its reply. Any thread. @return how many there were
    std::size_t drop(const GuidBytes& writer);

    /// Forgets every open request without an answer and tells its planner to stop, where others
    /// are left who answer it. Any thread. @return how many there were
    std::size_t hand_over();

    /// Takes no more requests: those that wait are answered CANCELLED, those being planned are
    /// told to stop and answered. One that is not ready after `grace` is answered CANCELLED without
    /// its planner; replies that are not written after twice `grace` are lost.
    /// @return whether every thread has ended; if not, only leaving the process ends them
    bool stop(std::chrono::milliseconds grace);

    ServiceCounters counters() const;

private:
    using Clock = std::chrono::steady_clock;

    /// Told to the planner of one request alone.
    using DropFlag = std::shared_ptr<std::atomic<bool>>;

    /// Taken in, not answered yet.
    struct Open {
        DropFlag dropped;
        AlarmClock::Id alarm;  ///< until a worker begins with it
        bool begun = false;
    };
    /// A thread that plans.
    struct Worker : std::enable_shared_from_this<Worker> {
        RequestPtr job;         ///< null: it waits for one
        AlarmClock::Id alarm;   ///< of the job
        bool replaced = false;  ///< another one took its place: it ends after its job
        bool ended = false;
        std::jthread thread;
    };

    void work(Worker& worker);
    void write_replies();
    void hire_locked();
    DropFlag begin(const RequestPtr& request, const std::shared_ptr<Worker>& worker);
    bool end(const std::shared_ptr<Worker>& worker, const PlanReply& reply,
             const Work& work) noexcept;
    void expire(const RequestPtr& request) noexcept;
    void answer_late_locked(const RequestPtr& request) noexcept;
    void overrun(const RequestPtr& request, const std::shared_ptr<Worker>& worker) noexcept;
    void abandon(const RequestPtr& request, const std::shared_ptr<Worker>& worker) noexcept;
    void lose_locked(const RequestPtr& request) noexcept;
    template <class Chosen>
    std::size_t cancel_those(Chosen&& chosen);
    PlanReply answer(const IncomingRequest& request, const DropFlag& dropped, Work& work);
    PlanReply process(const IncomingRequest& request, const StopQuery& stop_requested, Work& work);
    PlanReply plan_request(const IncomingRequest& request, PlanRequest problem, StoredObject object,
                           const StopQuery& stop_requested, Work& work);
    std::shared_ptr<const PlanSubject> drawable(PlanRequest& problem, PreparedObjectPtr object,
                                                const PlanReply& reply) const;
    StoredObject known_object(const std::string& key, const PlanRequest& problem);
    bool write(const OutgoingReply& reply) const noexcept;
    void receive(const RequestPtr& request);
    void finish(const RequestPtr& request, const PlanReply& reply, const Work& work);
    void finish_locked(const RequestPtr& request, const PlanReply& reply, const Work& work);
    void send_locked(OutgoingReply reply, const Work& work);

    const ServiceParts parts_;
    const std::uint32_t worker_count_;
    const std::uint32_t most_abandoned_;
    const std::chrono::milliseconds abandon_after_;
    const std::uint64_t max_memory_bytes_;
    const MarkersWhen markers_;
    BoundedQueue<RequestPtr> queue_;
    BoundedQueue<Answer> outbox_;
    ObjectStore objects_;
    std::stop_source stop_;

    mutable std::mutex mutex_;  ///< guards what follows
    std::condition_variable changed_;
    ReplyCache cache_;
    std::unordered_map<RequestPtr, Open> open_;
    LatencyWindow latencies_;
    ServiceCounters counters_;
    std::size_t running_ = 0;  ///< workers that have not ended
    bool writing_ = false;     ///< the writer thread has not ended

    AlarmClock alarms_;
    std::vector<std::shared_ptr<Worker>> workers_;
    std::jthread writer_;
};

}  // namespace graspd::server
