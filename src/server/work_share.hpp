#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "graspd/dds/planner_port.hpp"
#include "server_config.hpp"

namespace graspd::server {

/// A snapshot of what is shared with whom.
struct ShareCounters {
    std::size_t peers = 0;         ///< other planners that serve
    std::size_t held = 0;          ///< requests that a peer is to answer
    std::uint64_t taken_over = 0;  ///< of these, that this planner took over, since the start
    std::uint64_t forgotten = 0;   ///< of these, that had no room
    bool takes_part = false;       ///< plans what falls to it
};

/// Decides which of the requests that all planners of a domain receive this one plans.
///
/// A request falls to one of the planners that serve (rendezvous.hpp); the others hold it until
/// they see its reply. When the planner that it fell to is lost, or stops, it falls to the next.
/// When no reply comes long after its time budget, it does too: a planner that came a moment
/// before may not have received it. So a request is planned at least once, and exactly once while
/// no planner comes or goes.
///
/// A planner that starts holds everything while it gets to know the others (kSettle), then tells
/// them that it is there, and takes its share when they have heard it (kHeard).
///
/// Switched off, it lets every request through. Any thread.
class WorkShare {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kSettle{1000};
    static constexpr std::chrono::milliseconds kHeard{200};
    /// Beyond its time budget, for a request whose reply does not come.
    static constexpr std::chrono::milliseconds kPatience{1000};

    /// Plans a request. `taken_over`: another planner should have.
    using Plan = std::function<void(std::unique_ptr<IncomingRequest>, bool taken_over)>;

    /// @param start  when this planner joined the domain
    WorkShare(const ShareConfig& config, Plan plan, Clock::time_point start);

    /// How peers know this planner; to be called before the first tick().
    void set_self(const GuidBytes& self);

    /// Takes over a request, to be planned now, later or never.
    void receive(std::unique_ptr<IncomingRequest> request, Clock::time_point now);
    /// A peer has begun or ceased to serve.
    void see(const GuidBytes& peer, bool serves, Clock::time_point now);
    /// A reply went over the wire.
    void answered(const std::string& reply_key, Clock::time_point now);
    /// The caller with this writer has gone: nobody waits for its service calls.
    void drop(const GuidBytes& writer);
    /// To be called some times a second. @return whether this planner is to say that it is there
    bool tick(Clock::time_point now);
    /// Takes no more. Where no peer is left to answer what is held, that is planned, or refused by
    /// whoever is to plan it. @return whether peers are left
    bool leave();

    ShareCounters counters() const;

private:
    struct Held {
        std::unique_ptr<IncomingRequest> request;
        std::string reply_key;
        Clock::time_point due;          ///< if there is no reply until then, it falls to the next
        std::vector<GuidBytes> silent;  ///< planners that it fell to and that gave none
        std::uint64_t bytes = 0;
    };
    using HeldList = std::list<Held>;
    using Requests = std::vector<std::unique_ptr<IncomingRequest>>;

    bool is_mine_locked(const IncomingRequest& request, const std::vector<GuidBytes>& silent) const;
    const GuidBytes* owner_locked(const IncomingRequest& request,
                                  const std::vector<GuidBytes>& silent) const;
    void hold_locked(std::unique_ptr<IncomingRequest> request);
    HeldList::iterator forget_locked(HeldList::iterator held);
    Requests take_mine_locked();
    bool pass_overdue_locked(Clock::time_point now);
    void plan_late(Requests requests, Clock::time_point now, bool taken_over);

    const ShareConfig config_;
    const Plan plan_;
    const Clock::time_point start_;

    mutable std::mutex mutex_;  ///< guards what follows; none is held while something is planned
    GuidBytes self_{};
    bool takes_ = false;  ///< has begun to take its share
    bool left_ = false;
    std::vector<GuidBytes> serving_;  ///< peers, and this planner when it takes_
    HeldList held_;                   ///< oldest first
    std::unordered_multimap<std::string, HeldList::iterator> by_reply_;
    std::uint64_t held_bytes_ = 0;
    /// Replies that came before their request did, as the wire does not keep the order of topics.
    std::unordered_map<std::string, Clock::time_point> early_replies_;
    ShareCounters counters_;
};

}  // namespace graspd::server
