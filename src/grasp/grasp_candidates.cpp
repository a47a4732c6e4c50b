#include "graspd/grasp/grasp_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"
#include "graspd/grasp/circle_cut.hpp"

namespace graspd {
namespace {

/// The points of a polyline whose distance from `center` is least within their surroundings: feet
/// of perpendiculars inside a segment, and vertices nearer than both neighbours.
std::vector<Eigen::Vector2d> nearest_places(std::span<const Eigen::Vector2d> line,
                                            const Eigen::Vector2d& center, double max_gap_m) {
    std::vector<Eigen::Vector2d> places;
    const auto distance = [&](std::size_t k) { return (line[k] - center).norm(); };
    for (std::size_t n = 0; n < line.size(); ++n) {
        const bool nearer_than_before =
            n == 0 || (line[n] - line[n - 1]).norm() > max_gap_m || distance(n) < distance(n - 1);
        const bool nearer_than_after = n + 1 == line.size() ||
                                       (line[n + 1] - line[n]).norm() > max_gap_m ||
                                       distance(n) <= distance(n + 1);
        if (nearer_than_before && nearer_than_after) places.push_back(line[n]);
        if (n + 1 == line.size()) break;
        const Eigen::Vector2d edge = line[n + 1] - line[n];
        const double squared = edge.squaredNorm();
        if (squared <= 0.0 || squared > max_gap_m * max_gap_m) continue;
        const double t = edge.dot(center - line[n]) / squared;
        if (t > 0.0 && t < 1.0) places.push_back(line[n] + t * edge);
    }
    return places;
}

std::vector<Eigen::Vector2d> partners_of(std::span<const Eigen::Vector2d> boundary,
                                         const Eigen::Vector2d& point, double opening_m,
                                         double max_gap_m, const GraspCandidatesConfig& config) {
    std::vector<Eigen::Vector2d> partners;
    const double first_width_m = opening_m / config.widths;
    for (std::uint32_t k = 1; k <= config.widths; ++k) {
        for (const CircleCut& cut :
             all_circle_cuts(boundary, point, first_width_m * k, 0, max_gap_m)) {
            partners.push_back(cut.point);
        }
    }
    if (config.tangent_widths) {
        const auto places = nearest_places(boundary, point, max_gap_m);
        partners.insert(partners.end(), places.begin(), places.end());
    }
    const double least_m = std::min(max_gap_m, 0.25 * first_width_m);
    const auto width = [&](const Eigen::Vector2d& q) { return (q - point).norm(); };
    std::erase_if(partners, [&](const Eigen::Vector2d& q) {
        return width(q) < least_m || width(q) > opening_m * (1.0 + 1e-9);
    });
    std::ranges::sort(partners, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return width(a) != width(b) ? width(a) < width(b) : lexicographic_less(a, b);
    });
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    return partners;
}

}  // namespace

Result<std::vector<GraspCandidate>> grasp_candidates(std::span<const Eigen::Vector2d> boundary,
                                                     std::span<const StepPoint> steps,
                                                     double opening_m, double max_gap_m,
                                                     const GraspCandidatesConfig& config) {
    if (auto bad = validate(config, "grasp_candidates.")) return *bad;
    if (auto bad = check_positive("grasp_candidates: opening_m", opening_m)) return *bad;
    if (!(max_gap_m > 0.0)) {
        return PlanError{
            PlanErrorCode::kInvalidInput,
            "grasp_candidates: max_gap_m = " + std::to_string(max_gap_m) + " is not above 0"};
    }
    if (auto bad = check_finite("grasp_candidates: boundary", boundary)) return *bad;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].point.allFinite()) continue;
        return PlanError{PlanErrorCode::kInvalidInput, "grasp_candidates: the point of steps[" +
                                                           std::to_string(i) + "] is not finite"};
    }
    std::vector<GraspCandidate> candidates;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Eigen::Vector2d& point = steps[i].point;
        for (const auto& partner : partners_of(boundary, point, opening_m, max_gap_m, config)) {
            candidates.push_back({point, partner, i});
        }
    }
    return candidates;
}

}  // namespace graspd
