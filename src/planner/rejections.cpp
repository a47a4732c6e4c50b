#include "rejections.hpp"

#include <algorithm>

namespace graspd::planner_detail {

void Rejections::add(const std::string& reason, std::uint64_t count) {
    if (count > 0) counts_[reason] += count;
}

void Rejections::add_miss(const std::string& reason, const Eigen::Isometry3d& X_PG, double margin,
                          const char* unit, double scale) {
    add(reason);
    note(reason, margin);
    keep({margin / scale, {X_PG, reason, margin, unit}});
}

void Rejections::keep(const Miss& miss) {
    const auto place = std::ranges::upper_bound(misses_, miss.relative, {}, &Miss::relative);
    misses_.insert(place, miss);  // after its equals: the first found stays
    if (misses_.size() > kMostMisses) misses_.pop_back();
}

void Rejections::keep(TracedCandidate candidate, const std::string& reason) {
    candidate.reason = reason;
    traced_candidates_.push_back(std::move(candidate));
}

void Rejections::merge(const Rejections& other) {
    for (const auto& [reason, count] : other.counts_) add(reason, count);
    for (const auto& [reason, margin] : other.least_margins_) note(reason, margin);
    for (const Miss& miss : other.misses_) keep(miss);
    if (!traced_) return;
    traced_candidates_.insert(traced_candidates_.end(), other.traced_candidates_.begin(),
                              other.traced_candidates_.end());
}

void Rejections::note(const std::string& reason, double margin) {
    const auto [entry, is_new] = least_margins_.try_emplace(reason, margin);
    if (!is_new) entry->second = std::min(entry->second, margin);
}

std::optional<double> Rejections::least_margin(const std::string& reason) const {
    const auto found = least_margins_.find(reason);
    if (found == least_margins_.end()) return std::nullopt;
    return found->second;
}

std::uint64_t Rejections::count(const std::string& reason) const {
    const auto found = counts_.find(reason);
    return found == counts_.end() ? 0 : found->second;
}

std::vector<RejectionCount> Rejections::counts() const {
    std::vector<RejectionCount> list;
    for (const auto& [reason, count] : counts_) list.push_back({reason, count});
    std::ranges::stable_sort(list, std::ranges::greater{}, &RejectionCount::count);
    return list;
}

std::vector<NearMiss> Rejections::misses() const {
    std::vector<NearMiss> list;
    for (const Miss& miss : misses_) list.push_back(miss.miss);
    return list;
}

}  // namespace graspd::planner_detail
