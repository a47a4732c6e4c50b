#include "work_share.hpp"

#include <algorithm>
#include <utility>

#include "make_reply.hpp"
#include "rendezvous.hpp"

namespace graspd::server {
namespace {

// A reply overtakes its request by less than this, and by fewer others.
constexpr std::chrono::milliseconds kEarly{1000};
constexpr std::size_t kMostEarly = 4096;

// Of a request as it is held, within a factor of two.
constexpr std::uint64_t kSentRequest_bytes = 2048;
constexpr std::uint64_t kSentPoint_bytes = 24;
constexpr std::uint64_t kSentFace_bytes = 12;

std::uint64_t bytes_of(const RequestSize& size) {
    return kSentRequest_bytes +
           kSentPoint_bytes * (size.vertices + size.points + size.obstacle_vertices) +
           kSentFace_bytes * (size.faces + size.obstacle_faces);
}

}  // namespace

WorkShare::WorkShare(const ShareConfig& config, Plan plan, Clock::time_point start)
    : config_(config), plan_(std::move(plan)), start_(start) {}

void WorkShare::set_self(const GuidBytes& self) {
    const std::scoped_lock lock(mutex_);
    self_ = self;
}

void WorkShare::receive(std::unique_ptr<IncomingRequest> request, Clock::time_point now) {
    if (config_.enabled) {
        const std::scoped_lock lock(mutex_);
        if (left_) return;
        if (!is_mine_locked(*request, {})) {
            const auto early = early_replies_.find(request->reply_key());
            const bool is_answered = early != early_replies_.end() && now - early->second < kEarly;
            if (!is_answered) hold_locked(std::move(request));
            return;
        }
    }
    plan_(std::move(request), false);
}

void WorkShare::see(const GuidBytes& peer, bool serves, Clock::time_point now) {
    Requests mine;
    {
        const std::scoped_lock lock(mutex_);
        std::erase(serving_, peer);
        if (serves) serving_.push_back(peer);
        mine = take_mine_locked();
    }
    plan_late(std::move(mine), now, true);
}

void WorkShare::answered(const std::string& reply_key, Clock::time_point now) {
    const std::scoped_lock lock(mutex_);
    const auto [first, last] = by_reply_.equal_range(reply_key);
    if (first == last) {
        if (early_replies_.size() < kMostEarly) early_replies_[reply_key] = now;
        return;
    }
    // Requests without an id have one key, and a reply for each.
    forget_locked(first->second);
}

void WorkShare::drop(const GuidBytes& writer) {
    const std::scoped_lock lock(mutex_);
    for (auto held = held_.begin(); held != held_.end();) {
        const IncomingRequest& request = *held->request;
        const bool is_gone = request.is_call() && request.identity().writer == writer;
        held = is_gone ? forget_locked(held) : std::next(held);
    }
}

bool WorkShare::tick(Clock::time_point now) {
    if (!config_.enabled) return true;
    Requests first;  // that came before it took any
    Requests mine;
    bool is_there = false;
    {
        const std::scoped_lock lock(mutex_);
        std::erase_if(early_replies_,
                      [&](const auto& reply) { return now - reply.second >= kEarly; });
        is_there = now - start_ >= kSettle && !left_;
        if (is_there && !takes_ && now - start_ >= kSettle + kHeard) {
            takes_ = true;
            serving_.push_back(self_);
            first = take_mine_locked();
        }
        if (pass_overdue_locked(now)) mine = take_mine_locked();
    }
    plan_late(std::move(first), now, false);
    plan_late(std::move(mine), now, true);
    return is_there;
}

bool WorkShare::leave() {
    Requests unanswered;
    bool is_last = false;
    {
        const std::scoped_lock lock(mutex_);
        left_ = true;
        if (takes_) std::erase(serving_, self_);
        takes_ = false;
        is_last = serving_.empty();
        for (Held& held : held_) unanswered.push_back(std::move(held.request));
        held_.clear();
        by_reply_.clear();
        held_bytes_ = 0;
    }
    if (!is_last) return true;
    for (auto& request : unanswered) plan_(std::move(request), false);
    return false;
}

ShareCounters WorkShare::counters() const {
    const std::scoped_lock lock(mutex_);
    ShareCounters now = counters_;
    now.peers = serving_.size() - (takes_ ? 1 : 0);
    now.held = held_.size();
    now.takes_part = takes_;
    return now;
}

const GuidBytes* WorkShare::owner_locked(const IncomingRequest& request,
                                         const std::vector<GuidBytes>& silent) const {
    const std::string key = rendezvous_key(request.identity());
    if (silent.empty()) return rendezvous_owner(key, serving_);
    std::vector<GuidBytes> others;
    std::ranges::copy_if(serving_, std::back_inserter(others), [&](const GuidBytes& planner) {
        return std::ranges::find(silent, planner) == silent.end();
    });
    const GuidBytes* owner = rendezvous_owner(key, others);
    return owner == nullptr ? nullptr : &*std::ranges::find(serving_, *owner);
}

bool WorkShare::is_mine_locked(const IncomingRequest& request,
                               const std::vector<GuidBytes>& silent) const {
    const GuidBytes* owner = owner_locked(request, silent);
    return takes_ && owner != nullptr && *owner == self_;
}

void WorkShare::hold_locked(std::unique_ptr<IncomingRequest> request) {
    Held held;
    held.reply_key = request->reply_key();
    held.due = deadline_of(*request) + kPatience;
    held.bytes = bytes_of(request->size());
    held.request = std::move(request);
    held_bytes_ += held.bytes;
    held_.push_back(std::move(held));
    by_reply_.emplace(held_.back().reply_key, std::prev(held_.end()));
    while (held_.size() > config_.max_held_requests || held_bytes_ > config_.max_held_bytes) {
        forget_locked(held_.begin());
        ++counters_.forgotten;
    }
}

WorkShare::HeldList::iterator WorkShare::forget_locked(HeldList::iterator held) {
    const auto [first, last] = by_reply_.equal_range(held->reply_key);
    by_reply_.erase(std::find_if(first, last, [&](const auto& at) { return at.second == held; }));
    held_bytes_ -= held->bytes;
    return held_.erase(held);
}

/// Those that fall to this planner now.
WorkShare::Requests WorkShare::take_mine_locked() {
    Requests mine;
    for (auto held = held_.begin(); held != held_.end();) {
        if (!is_mine_locked(*held->request, held->silent)) {
            ++held;
            continue;
        }
        mine.push_back(std::move(held->request));
        held = forget_locked(held);
    }
    return mine;
}

/// Those whose reply has not come fall to the next. @return whether there are any
bool WorkShare::pass_overdue_locked(Clock::time_point now) {
    bool passed = false;
    for (Held& held : held_) {
        if (now < held.due) continue;
        if (const GuidBytes* owner = owner_locked(*held.request, held.silent)) {
            held.silent.push_back(*owner);
        }
        held.due = now + (held.due - held.request->received());
        held.request->take_over(now);
        passed = true;
    }
    return passed;
}

/// What was held until now, with its whole time budget.
void WorkShare::plan_late(Requests requests, Clock::time_point now, bool taken_over) {
    for (auto& request : requests) {
        request->take_over(now);
        plan_(std::move(request), taken_over);
    }
    if (!taken_over || requests.empty()) return;
    const std::scoped_lock lock(mutex_);
    counters_.taken_over += requests.size();
}

}  // namespace graspd::server
