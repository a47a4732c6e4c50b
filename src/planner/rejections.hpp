#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graspd/planner/plan_types.hpp"

namespace graspd::planner_detail {

/// Why candidates fell: counts by typed reason and the nearest misses.
class Rejections {
public:
    static constexpr std::size_t kMostMisses = 3;

    void add(const std::string& reason, std::uint64_t count = 1);
    /// With a margin: by how much it failed, in `unit`; `scale` makes margins comparable.
    void add_miss(const std::string& reason, const Eigen::Isometry3d& X_PG, double margin,
                  const char* unit, double scale);
    void merge(const Rejections& other);

    std::uint64_t count(const std::string& reason) const;
    std::vector<RejectionCount> counts() const;  ///< most frequent first, ties by name
    std::vector<NearMiss> misses() const;        ///< nearest first, poses in P
    /// Of all misses by a reason, also those that are not among the nearest, the least margin.
    std::optional<double> least_margin(const std::string& reason) const;

private:
    struct Miss {
        double relative = 0.0;
        NearMiss miss;
    };
    void keep(const Miss& miss);

    void note(const std::string& reason, double margin);

    std::map<std::string, std::uint64_t> counts_;
    std::map<std::string, double> least_margins_;
    std::vector<Miss> misses_;
};

}  // namespace graspd::planner_detail
