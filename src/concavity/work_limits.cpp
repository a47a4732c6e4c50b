#include "work_limits.hpp"

#include <sstream>

#include "graspd/base/stop.hpp"

namespace graspd::concavity_detail {

WorkLimits::WorkLimits(const TetrahedralConfig& config)
    : config_(config), start_(std::chrono::steady_clock::now()) {}

std::optional<PlanError> WorkLimits::exceeded(std::size_t cells) const {
    stop_point();
    std::ostringstream text;
    if (cells > config_.max_cells) {
        text << "tetrahedral_concavity.max_cells = " << config_.max_cells << " is passed: " << cells
             << " tetrahedra at cell_size = " << config_.cell_size;
        return PlanError{PlanErrorCode::kTooLarge, text.str()};
    }
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start_;
    if (spent.count() < config_.max_time_ms) return std::nullopt;
    text << "tetrahedral_concavity.max_time_ms = " << config_.max_time_ms << " is passed at "
         << cells << " tetrahedra, cell_size = " << config_.cell_size;
    return PlanError{PlanErrorCode::kTooLarge, text.str()};
}

}  // namespace graspd::concavity_detail
