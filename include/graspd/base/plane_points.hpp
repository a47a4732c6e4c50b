#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd {

// What the stages that work in a plane share: one order of points and one wording of their errors.

/// Lexicographic order: by x, then by y. Total for finite points; what makes a stage independent of
/// the order in which its points arrive. An object, which algorithms inline as no function is.
inline constexpr auto lexicographic_less = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
};

/// Checks that every coordinate is a finite number.
/// @return nothing, or kInvalidInput naming `name`, the index and the values
std::optional<PlanError> check_finite(const char* name, std::span<const Eigen::Vector2d> points);

/// Checks that a length is a finite number above 0.
/// @return nothing, or kInvalidInput naming `name` and the value
std::optional<PlanError> check_positive(const char* name, double value_m);

}  // namespace graspd
