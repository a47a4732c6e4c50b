#include "graspd/contour/boundary_points.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

std::optional<PlanError> check_loop(const char* name, std::span<const Eigen::Vector2d> loop) {
    if (auto bad = check_finite(name, loop)) return bad;
    if (loop.size() >= 3) return std::nullopt;
    return PlanError{
        PlanErrorCode::kDegenerate,
        std::string(name) + " has " + std::to_string(loop.size()) + " points, a loop has 3"};
}

/// Least distance from `n` to a foot of a perpendicular on the loop [m]; infinite without a foot.
double distance_to_loop_m(const Eigen::Vector2d& n, std::span<const Eigen::Vector2d> loop) {
    double least_m2 = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < loop.size(); ++m) {
        const Eigen::Vector2d edge = loop[(m + 1) % loop.size()] - loop[m];
        const double length_m2 = edge.squaredNorm();
        const double t = length_m2 > 0.0 ? (n - loop[m]).dot(edge) / length_m2 : 0.0;
        if (t < 0.0 || t > 1.0) continue;
        least_m2 = std::min(least_m2, (loop[m] + t * edge - n).squaredNorm());
    }
    return std::sqrt(least_m2);
}

}  // namespace

Result<std::vector<Eigen::Vector2d>> boundary_points(
    std::span<const Eigen::Vector2d> cluster_outline,
    std::span<const Eigen::Vector2d> enlarged_outline, double spacing_m,
    const BoundaryPointsConfig& config) {
    if (auto bad = validate(config, "boundary_points.")) return *bad;
    if (auto bad = check_positive("boundary_points: spacing_m", spacing_m)) return *bad;
    if (auto bad = check_loop("boundary_points: cluster_outline", cluster_outline)) return *bad;
    if (auto bad = check_loop("boundary_points: enlarged_outline", enlarged_outline)) return *bad;
    const double d_threshold_m = config.d_threshold_spacings * spacing_m;
    std::vector<Eigen::Vector2d> boundary;
    for (const Eigen::Vector2d& n : cluster_outline) {
        if (distance_to_loop_m(n, enlarged_outline) < d_threshold_m) boundary.push_back(n);
    }
    return boundary;
}

}  // namespace graspd
