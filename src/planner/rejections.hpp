#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graspd/planner/plan_trace.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::planner_detail {

/// Why candidates fell: counts by typed reason and the nearest misses. With a trace every candidate
/// is kept as well, as `make` returns it; without one `make` is not called.
class Rejections {
public:
    static constexpr std::size_t kMostMisses = 3;

    Rejections() = default;
    explicit Rejections(bool traced) : traced_(traced) {}

    void add(const std::string& reason, std::uint64_t count = 1);
    /// With a margin: by how much it failed, in `unit`; `scale` makes margins comparable.
    void add_miss(const std::string& reason, const Eigen::Isometry3d& X_PG, double margin,
                  const char* unit, double scale);
    /// One that fell.
    template <std::invocable Make>
    void add(const std::string& reason, Make&& make) {
        add(reason);
        if (traced_) keep(std::forward<Make>(make)(), reason);
    }
    /// One that fell, where its hand stood, with a margin.
    template <std::invocable Make>
    void add_miss(const NearMiss& miss, double scale, Make&& make) {
        add_miss(miss.reason, miss.X_FG, miss.margin, miss.unit.c_str(), scale);
        if (!traced_) return;
        keep(std::forward<Make>(make)(), miss.reason);
        traced_candidates_.back().margin = miss.margin;
        traced_candidates_.back().unit = miss.unit;
    }
    /// One that did not fall.
    template <std::invocable Make>
    void trace(Make&& make) {
        if (traced_) traced_candidates_.push_back(std::forward<Make>(make)());
    }
    /// Adds the other's counts, misses and, with a trace, candidates after ours.
    void merge(const Rejections& other);

    std::uint64_t count(const std::string& reason) const;
    std::vector<RejectionCount> counts() const;  ///< most frequent first, ties by name
    std::vector<NearMiss> misses() const;        ///< nearest first, poses in P
    const std::vector<TracedCandidate>& traced_candidates() const { return traced_candidates_; }
    /// Of all misses by a reason, also those that are not among the nearest, the least margin.
    std::optional<double> least_margin(const std::string& reason) const;

private:
    struct Miss {
        double relative = 0.0;
        NearMiss miss;
    };
    void keep(const Miss& miss);
    void keep(TracedCandidate candidate, const std::string& reason);
    void note(const std::string& reason, double margin);

    std::map<std::string, std::uint64_t> counts_;
    std::map<std::string, double> least_margins_;
    std::vector<Miss> misses_;
    bool traced_ = false;
    std::vector<TracedCandidate> traced_candidates_;
};

}  // namespace graspd::planner_detail
