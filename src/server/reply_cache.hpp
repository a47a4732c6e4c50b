#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "graspd/dds/planner_port.hpp"

namespace graspd::server {

using RequestPtr = std::shared_ptr<const IncomingRequest>;

/// How much the cache may hold.
struct ReplyCacheLimits {
    std::size_t entries = 1024;           ///< identities with their replies
    std::uint64_t bytes = 64u << 20;      ///< [bytes] of those replies together
    std::size_t waiting_retries = 65536;  ///< retries that wait for a request being planned
};

/// What is to be done with a request that has just come in.
enum class Admission : std::uint8_t {
    kPlan,        ///< new: plan it, then call complete()
    kWait,        ///< a retry of one that is being planned: complete() of that one answers it
    kAnswered,    ///< a retry: here is the reply
    kOverloaded,  ///< a retry of one being planned, and too many wait already
    kClash,       ///< the writer used this request_id for other bytes
};

/// A request and the number of its answer.
struct NumberedRequest {
    RequestPtr request;
    std::uint32_t attempt = 1;
};

/// Memory that a reply takes, within a few per cent [bytes].
std::uint64_t reply_bytes(const PlanReply& reply);

/// Whether a retry gets this reply again. Refusals that say nothing about the request itself
/// (OVERLOADED, CANCELLED, UNKNOWN_OBJECT) are not repeated: a retry gets a new chance.
bool repeats(PlanStatus status);

/// Makes request ids idempotent: a request is (writer, request_id, payload hash), planned once and
/// answered as often as it is sent, with `attempt` rising by one each time. Replies are kept in
/// the limits, the oldest is dropped first; requests being planned are never dropped. A request
/// without an id has no identity and is always new. Not thread-safe: its owner locks.
class ReplyCache {
public:
    explicit ReplyCache(const ReplyCacheLimits& limits) : limits_(limits) {}

    struct Admitted {
        Admission admission = Admission::kPlan;
        std::uint32_t attempt = 1;               ///< of an answer given at once
        std::shared_ptr<const PlanReply> reply;  ///< for kAnswered
    };
    Admitted admit(const RequestPtr& request);

    /// Ends what kPlan began and keeps the reply when it repeats().
    /// @return the request and the retries that waited for it, in the order of their arrival
    std::vector<NumberedRequest> complete(const RequestPtr& request, const PlanReply& reply);

    std::size_t entries() const { return entries_.size(); }
    std::uint64_t bytes() const { return bytes_; }

private:
    using Key = std::string;  ///< the writer's sixteen bytes, then the request_id
    struct Entry {
        std::uint64_t payload_hash = 0;
        std::uint32_t answers = 0;  ///< given so far
        bool planning = true;
        std::vector<RequestPtr> waiting;
        std::shared_ptr<const PlanReply> reply;  ///< null: planning, or a refusal
        std::uint64_t bytes = 0;
        std::list<Key>::iterator age;  ///< into oldest_first_ unless planning
    };
    static Key key_of(const RequestIdentity& identity);
    void drop_oldest();

    const ReplyCacheLimits limits_;
    std::unordered_map<Key, Entry> entries_;
    std::list<Key> oldest_first_;  ///< those that are not being planned
    std::uint64_t bytes_ = 0;
    std::size_t waiting_ = 0;
};

}  // namespace graspd::server
