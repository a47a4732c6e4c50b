#include "graspd/grasp/step_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "graspd/base/plane_points.hpp"
#include "graspd/grasp/circle_cut.hpp"

namespace graspd {
namespace {

// A boundary of one metre in steps of 10 um; far beyond any gripper, far below a second of work.
constexpr double kMaxSteps = 1e5;

double length_m(std::span<const Eigen::Vector2d> polyline) {
    double sum = 0.0;
    for (std::size_t n = 0; n + 1 < polyline.size(); ++n) {
        sum += (polyline[n + 1] - polyline[n]).norm();
    }
    return sum;
}

std::optional<PlanError> check_input(std::span<const Eigen::Vector2d> boundary, double step_m,
                                     double hand_width_m, double max_gap_m) {
    if (auto bad = check_positive("step_points: step_m", step_m)) return bad;
    if (auto bad = check_positive("step_points: hand_width_m", hand_width_m)) return bad;
    if (!(max_gap_m > 0.0)) {
        return PlanError{
            PlanErrorCode::kInvalidInput,
            "step_points: max_gap_m = " + std::to_string(max_gap_m) + " is not above 0"};
    }
    if (auto bad = check_finite("step_points: boundary", boundary)) return bad;
    if (boundary.size() < 2) {
        return PlanError{PlanErrorCode::kDegenerate, "step_points: boundary has " +
                                                         std::to_string(boundary.size()) +
                                                         " points, at least 2 are needed"};
    }
    const double steps = length_m(boundary) / step_m;
    if (!(steps <= kMaxSteps)) {
        std::ostringstream text;
        text << "step_points: step_m = " << step_m << " divides the boundary into " << steps
             << " steps, more than " << kMaxSteps;
        return PlanError{PlanErrorCode::kTooLarge, text.str()};
    }
    return std::nullopt;
}

/// The largest distance from the step point, which stands first, to the rest [m].
double farthest_m(std::span<const Eigen::Vector2d> remaining) {
    double farthest = 0.0;
    for (const Eigen::Vector2d& point : remaining) {
        farthest = std::max(farthest, (point - remaining.front()).norm());
    }
    return farthest;
}

/// The next step point; `remaining` begins with the current one. Its segment counts from there.
std::optional<StepPoint> next_step(std::span<const Eigen::Vector2d> remaining, double step_m,
                                   double max_gap_m) {
    for (std::size_t n = 0; n + 1 < remaining.size(); ++n) {
        if ((remaining[n + 1] - remaining[n]).norm() > max_gap_m) {
            return StepPoint{remaining[n + 1], n + 1};
        }
        const auto cut =
            first_circle_cut(remaining.subspan(n, 2), remaining.front(), step_m, 0, max_gap_m);
        if (cut) return StepPoint{cut->point, n};
    }
    return std::nullopt;
}

}  // namespace

Result<std::vector<StepPoint>> step_points(std::span<const Eigen::Vector2d> boundary, double step_m,
                                           double hand_width_m, double max_gap_m) {
    if (auto bad = check_input(boundary, step_m, hand_width_m, max_gap_m)) return *bad;
    // Point n of the row is overwritten by a step point on [n, n+1]: "drop 0..n, put P in front".
    std::vector<Eigen::Vector2d> row(boundary.begin(), boundary.end());
    const std::size_t last_segment = boundary.size() - 2;
    // A step uses up at least step_m of the boundary, a jump at least one point.
    const auto bound = static_cast<std::size_t>(length_m(boundary) / step_m) + boundary.size() + 1;

    std::vector<StepPoint> steps{{boundary.front(), 0}};
    std::size_t current = 0;
    while (steps.size() < bound) {
        const auto remaining = std::span<const Eigen::Vector2d>(row).subspan(current);
        if (farthest_m(remaining) <= hand_width_m) break;
        const auto next = next_step(remaining, step_m, max_gap_m);
        if (!next) break;
        current += next->segment;
        row[current] = next->point;
        steps.push_back({next->point, std::min(current, last_segment)});
    }
    return steps;
}

}  // namespace graspd
