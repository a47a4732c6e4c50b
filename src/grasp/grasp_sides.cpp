#include "graspd/grasp/grasp_sides.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

/// Per bin of y the point that a pad coming from -x meets first, by rising y.
std::vector<Eigen::Vector2d> seen_from_minus_x(std::span<const Eigen::Vector2d> points,
                                               double bin_m) {
    std::map<double, Eigen::Vector2d> first;  // by number of the bin; a double holds any of them
    for (const Eigen::Vector2d& point : points) {
        const auto [entry, is_new] = first.try_emplace(std::floor(point.y() / bin_m), point);
        if (!is_new && lexicographic_less(point, entry->second)) entry->second = point;
    }
    std::vector<Eigen::Vector2d> side;
    for (const auto& [bin, point] : first) side.push_back(point);
    return side;
}

void drop_deeper(std::vector<Eigen::Vector2d>& side, double max_depth_m) {
    if (side.empty()) return;
    const double touch_m = std::ranges::min_element(side, lexicographic_less)->x();
    std::erase_if(side,
                  [&](const Eigen::Vector2d& point) { return point.x() - touch_m > max_depth_m; });
}

std::optional<PlanError> check_count(const char* name, std::size_t count,
                                     std::uint32_t min_points) {
    if (count >= min_points) return std::nullopt;
    return PlanError{PlanErrorCode::kDegenerate,
                     std::string("grasp_sides: ") + name + " has " + std::to_string(count) +
                         " points, min_points = " + std::to_string(min_points)};
}

}  // namespace

Result<GraspSides> grasp_sides(std::span<const Eigen::Vector2d> local_G, double spacing_m,
                               const GraspSidesConfig& config) {
    if (auto bad = validate(config, "grasp_sides.")) return *bad;
    if (auto bad = check_positive("grasp_sides: spacing_m", spacing_m)) return *bad;
    if (auto bad = check_finite("grasp_sides: local_G", local_G)) return *bad;
    const double bin_m = config.bin_spacings * spacing_m;

    // The right side is the left side of the mirror image.
    const auto mirror = [](std::vector<Eigen::Vector2d> points) {
        for (Eigen::Vector2d& point : points) point.x() = -point.x();
        return points;
    };
    const auto mirrored = mirror({local_G.begin(), local_G.end()});
    GraspSides sides{seen_from_minus_x(local_G, bin_m), seen_from_minus_x(mirrored, bin_m)};
    drop_deeper(sides.left_G, config.max_depth_m);
    drop_deeper(sides.right_G, config.max_depth_m);
    sides.right_G = mirror(std::move(sides.right_G));
    if (auto bad = check_count("left_G", sides.left_G.size(), config.min_points)) return *bad;
    if (auto bad = check_count("right_G", sides.right_G.size(), config.min_points)) return *bad;
    return sides;
}

}  // namespace graspd
