#include "reply_cache.hpp"

namespace graspd::server {

std::uint64_t reply_bytes(const PlanReply& reply) {
    std::uint64_t bytes = sizeof(PlanReply) + reply.request_id.size() + reply.frame_id.size() +
                          reply.object_key.size() + reply.message.size() + reply.strategy.size() +
                          reply.report.suggestion.size();
    for (const Grasp& grasp : reply.grasps) {
        bytes += sizeof(Grasp) + grasp.gripper_name.size();
        for (const ScoreTerm& term : grasp.terms) bytes += sizeof(ScoreTerm) + term.name.size();
    }
    const PlanReport& report = reply.report;
    for (const auto& stage : report.stages) bytes += sizeof(StageReport) + stage.name.size();
    for (const auto& count : report.rejections) {
        bytes += sizeof(RejectionCount) + count.reason.size();
    }
    for (const auto& miss : report.near_misses) bytes += sizeof(NearMiss) + miss.reason.size();
    for (const auto& finding : report.findings) {
        bytes += sizeof(Finding) + finding.code.size() + finding.detail.size();
    }
    return bytes;
}

bool repeats(PlanStatus status) {
    return status != PlanStatus::kOverloaded && status != PlanStatus::kCancelled &&
           status != PlanStatus::kUnknownObject;
}

ReplyCache::Key ReplyCache::key_of(const RequestIdentity& identity) {
    Key key(identity.writer.begin(), identity.writer.end());
    return key + identity.request_id;
}

ReplyCache::Admitted ReplyCache::admit(const RequestPtr& request) {
    const RequestIdentity& identity = request->identity();
    if (identity.request_id.empty()) return {};
    const auto [at, is_new] = entries_.try_emplace(key_of(identity));
    Entry& entry = at->second;
    if (is_new) {
        entry.payload_hash = identity.payload_hash;
        return {};
    }
    if (entry.payload_hash != identity.payload_hash) return {Admission::kClash, 1, nullptr};
    if (entry.planning && waiting_ < limits_.waiting_retries) {
        entry.waiting.push_back(request);
        ++waiting_;
        return {Admission::kWait, 1, nullptr};
    }
    if (entry.planning) {
        return {Admission::kOverloaded, ++entry.answers, nullptr};
    }
    if (entry.reply != nullptr) {
        return {Admission::kAnswered, ++entry.answers, entry.reply};
    }
    entry.planning = true;  // it was refused before; now it is tried again
    oldest_first_.erase(entry.age);
    return {};
}

std::vector<NumberedRequest> ReplyCache::complete(const RequestPtr& request,
                                                  const PlanReply& reply) {
    const auto at = request->identity().request_id.empty()
                        ? entries_.end()
                        : entries_.find(key_of(request->identity()));
    if (at == entries_.end()) return {{request, 1}};
    Entry& entry = at->second;
    std::vector<NumberedRequest> answered = {{request, ++entry.answers}};
    for (RequestPtr& retry : entry.waiting) {
        answered.push_back({std::move(retry), ++entry.answers});
    }
    waiting_ -= entry.waiting.size();
    entry.waiting.clear();
    entry.waiting.shrink_to_fit();
    entry.planning = false;
    entry.age = oldest_first_.insert(oldest_first_.end(), at->first);
    if (repeats(reply.status)) {
        entry.reply = std::make_shared<const PlanReply>(reply);
        entry.bytes = reply_bytes(reply);
        bytes_ += entry.bytes;
    }
    while (oldest_first_.size() > 1 &&
           (oldest_first_.size() > limits_.entries || bytes_ > limits_.bytes)) {
        drop_oldest();
    }
    return answered;
}

void ReplyCache::drop_oldest() {
    const auto at = entries_.find(oldest_first_.front());
    bytes_ -= at->second.bytes;
    entries_.erase(at);
    oldest_first_.pop_front();
}

}  // namespace graspd::server
