#include "graspd/base/plane_points.hpp"

#include <cmath>
#include <cstddef>
#include <sstream>

namespace graspd {

std::optional<PlanError> check_finite(const char* name, std::span<const Eigen::Vector2d> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].allFinite()) continue;
        std::ostringstream text;
        text << name << "[" << i << "] = (" << points[i].x() << ", " << points[i].y()
             << ") is not finite";
        return PlanError{PlanErrorCode::kInvalidInput, text.str()};
    }
    return std::nullopt;
}

std::optional<PlanError> check_positive(const char* name, double value_m) {
    if (std::isfinite(value_m) && value_m > 0.0) return std::nullopt;
    std::ostringstream text;
    text << name << " = " << value_m << " is not a finite number above 0";
    return PlanError{PlanErrorCode::kInvalidInput, text.str()};
}

}  // namespace graspd
