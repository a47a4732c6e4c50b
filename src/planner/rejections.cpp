#include "rejections.hpp"

#include <algorithm>

namespace graspd::planner_detail {

void Rejections::add(const std::string& reason, std::uint64_t count) {
    if (count > 0) counts_[reason] += count;
}

void Rejections::add_miss(const std::string& reason, const Eigen::Isometry3d& X_PG, double margin,
                          const char* unit, double scale) {
    add(reason);
    keep({margin / scale, {X_PG, reason, margin, unit}});
}

void Rejections::keep(const Miss& miss) {
    const auto place = std::ranges::upper_bound(misses_, miss.relative, {}, &Miss::relative);
    misses_.insert(place, miss);  // after its equals: the first found stays
    if (misses_.size() > kMostMisses) misses_.pop_back();
}

void Rejections::merge(const Rejections& other) {
    for (const auto& [reason, count] : other.counts_) add(reason, count);
    for (const Miss& miss : other.misses_) keep(miss);
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
