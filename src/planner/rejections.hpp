#pragma once

#include <cstdint>
#include <map>
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

    std::vector<RejectionCount> counts() const;  ///< most frequent first, ties by name
    std::vector<NearMiss> misses() const;        ///< nearest first, poses in P

private:
    struct Miss {
        double relative = 0.0;
        NearMiss miss;
    };
    void keep(const Miss& miss);

    std::map<std::string, std::uint64_t> counts_;
    std::vector<Miss> misses_;
};

}  // namespace graspd::planner_detail
