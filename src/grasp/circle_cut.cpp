#include "graspd/grasp/circle_cut.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace graspd {
namespace {

struct Circle {
    Eigen::Vector2d center;
    double radius_m;
};

/// Eq. (2) and (3) on one segment.
std::optional<Eigen::Vector2d> cut_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                           const Circle& circle) {
    const double r = circle.radius_m;
    const double d_from = (from - circle.center).norm();
    const double d_to = (to - circle.center).norm();
    const bool is_cut = (d_from <= r && r <= d_to) || (d_from >= r && r >= d_to);
    if (!is_cut) return std::nullopt;
    if (d_from == r) return from;  // exact, so that a vertex on the circle is known as one point
    if (d_to == r) return to;

    // |from + t edge - center|^2 = r^2, or a t^2 + 2 b t + c = 0. From inside the circle the
    // greater root is the way out, from outside the smaller one the way in; both in the form that
    // does not subtract nearly equal numbers.
    const Eigen::Vector2d edge = to - from;
    const double a = edge.squaredNorm();
    const double b = (from - circle.center).dot(edge);
    const double c = (d_from - r) * (d_from + r);
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    double t = 0.0;
    if (c > 0.0) {
        t = c / (root - b);
    } else {
        t = b > 0.0 ? -c / (b + root) : (root - b) / a;
    }
    return from + std::clamp(t, 0.0, 1.0) * edge;
}

/// The first cut at or after a segment.
std::optional<CircleCut> next_cut(std::span<const Eigen::Vector2d> polyline, const Circle& circle,
                                  std::size_t from_segment, double max_gap_m) {
    for (std::size_t n = from_segment; n + 1 < polyline.size(); ++n) {
        if ((polyline[n + 1] - polyline[n]).norm() > max_gap_m) continue;
        if (const auto point = cut_segment(polyline[n], polyline[n + 1], circle)) {
            return CircleCut{*point, n};
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<CircleCut> first_circle_cut(std::span<const Eigen::Vector2d> polyline,
                                          const Eigen::Vector2d& center, double radius_m,
                                          std::size_t from_segment, double max_gap_m) {
    assert(radius_m > 0.0 && max_gap_m > 0.0);
    return next_cut(polyline, {center, radius_m}, from_segment, max_gap_m);
}

std::vector<CircleCut> all_circle_cuts(std::span<const Eigen::Vector2d> polyline,
                                       const Eigen::Vector2d& center, double radius_m,
                                       std::size_t from_segment, double max_gap_m) {
    assert(radius_m > 0.0 && max_gap_m > 0.0);
    std::vector<CircleCut> cuts;
    const Circle circle{center, radius_m};
    auto cut = next_cut(polyline, circle, from_segment, max_gap_m);
    while (cut) {
        if (cuts.empty() || cuts.back().point != cut->point) cuts.push_back(*cut);
        cut = next_cut(polyline, circle, cut->segment + 1, max_gap_m);
    }
    return cuts;
}

}  // namespace graspd
