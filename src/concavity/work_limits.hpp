#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "graspd/base/result.hpp"
#include "graspd/concavity/tetrahedral_concavity.hpp"

namespace graspd::concavity_detail {

/// How much tetrahedral_concavity may do. The clock starts with construction; it only ends work.
class WorkLimits {
public:
    explicit WorkLimits(const TetrahedralConfig& config);

    /// @param cells  tetrahedra so far, or those that the points so far will make
    /// @return kTooLarge when a limit is passed, naming the limit, its value and what was reached
    std::optional<PlanError> exceeded(std::size_t cells) const;

    const TetrahedralConfig& config() const { return config_; }

private:
    TetrahedralConfig config_;
    std::chrono::steady_clock::time_point start_;
};

/// Points of a Delaunay tetrahedralisation make about so many tetrahedra each (Poisson
/// points: 6.8).
constexpr std::size_t kCellsPerPoint = 6;

}  // namespace graspd::concavity_detail
