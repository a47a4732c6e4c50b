#include "graspd/contour/concave_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Eigenvalues>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

using Loop = std::vector<Eigen::Vector2d>;

// Nearer points say nothing new about an outline along which a disc of a spacing or more rolls.
constexpr double kLeastGap_spacings = 0.25;
// Thinner sets have no triangle whose circumscribed circle fits any alpha.
constexpr double kLeastThickness_spacings = 1e-3;
constexpr double kAlphaGrowth = 1.15;
constexpr int kMaxGrowths = 10;  // 4 times the configured alpha: no longer the shape asked for

PlanError degenerate(const std::string& detail) {
    return PlanError{PlanErrorCode::kDegenerate, "concave_hull: " + detail};
}

/// Points of which no two are nearer than a gap, found by strips along x: whoever comes in rising x
/// meets those that may be too near at the ends of three strips.
class SpacedPoints {
public:
    explicit SpacedPoints(double least_gap_m) : least_gap_m_(least_gap_m), last_(kStrips, kNone) {}

    /// Takes a point unless it is too near; its x is no less than any before.
    void offer(const Eigen::Vector2d& point) {
        const std::uint64_t strip = strip_of(point);
        for (const std::uint64_t at : {strip - 1, strip, strip + 1}) {
            if (is_near_one_of(at % kStrips, point)) return;
        }
        before_.push_back(
            std::exchange(last_[strip % kStrips], static_cast<std::uint32_t>(points_.size())));
        points_.push_back(point);
    }
    std::vector<Eigen::Vector2d> take() { return std::move(points_); }

private:
    static constexpr std::uint64_t kStrips = 1024;  // after as many they are the first ones again
    static constexpr std::uint32_t kNone = 0xffffffff;

    /// Modulo 2^64, of which kStrips is a part: below zero the strips follow one another as well.
    std::uint64_t strip_of(const Eigen::Vector2d& point) const {
        constexpr double kHigh = 1.5;       // rounding puts no near one two strips away
        constexpr double kFarthest = 1e14;  // whole numbers beyond have no neighbours
        const double strip = std::floor(point.y() / (kHigh * least_gap_m_));
        return static_cast<std::uint64_t>(
            static_cast<std::int64_t>(std::clamp(strip, -kFarthest, kFarthest)));
    }
    bool is_near_one_of(std::uint64_t strip, const Eigen::Vector2d& point) const {
        for (std::uint32_t k = last_[strip]; k != kNone; k = before_[k]) {
            if (point.x() - points_[k].x() >= least_gap_m_) return false;
            if ((point - points_[k]).norm() < least_gap_m_) return true;
        }
        return false;
    }

    double least_gap_m_;
    std::vector<std::uint32_t> last_;    ///< by strip: its last point
    std::vector<std::uint32_t> before_;  ///< by point: the one before it in its strip
    std::vector<Eigen::Vector2d> points_;
};

/// Sorted points of which no two are nearer than `least_gap_m`.
std::vector<Eigen::Vector2d> thin_out(std::span<const Eigen::Vector2d> points, double least_gap_m) {
    std::vector<Eigen::Vector2d> sorted(points.begin(), points.end());
    std::ranges::sort(sorted, lexicographic_less);
    SpacedPoints spaced(least_gap_m);
    for (const Eigen::Vector2d& point : sorted) spaced.offer(point);
    return spaced.take();
}

Eigen::Vector2d mean_of(std::span<const Eigen::Vector2d> points) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& point : points) sum += point;
    return sum / static_cast<double>(points.size());
}

/// Standard deviation across the thinnest direction [m].
double thickness_m(std::span<const Eigen::Vector2d> points) {
    const Eigen::Vector2d mean = mean_of(points);
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Eigen::Vector2d& point : points) {
        scatter += (point - mean) * (point - mean).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter, Eigen::EigenvaluesOnly);
    const double least = std::max(0.0, solver.eigenvalues()[0]);
    return std::sqrt(least / static_cast<double>(points.size()));
}

/// Delaunay triangulation of points, each triangle with its circumscribed circle.
class Triangulation {
public:
    /// @param points  [m], no two alike; centred before CGAL's constructions, so that no digits are
    ///                lost far from the origin
    explicit Triangulation(std::span<const Eigen::Vector2d> points) {
        const Eigen::Vector2d mean = mean_of(points);
        std::vector<std::pair<Kernel::Point_2, std::size_t>> numbered;
        numbered.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            numbered.emplace_back(
                Kernel::Point_2(points[i].x() - mean.x(), points[i].y() - mean.y()), i);
        }
        mesh_.insert(numbered.begin(), numbered.end());
        for (const auto& face : mesh_.finite_face_handles()) face->info() = radius_m(face);
    }

    /// For each point on the border of the triangles whose circles fit `alpha_m` the next one, with
    /// the shape on the left. None where a point has two: the shape is pinched there.
    std::optional<std::map<std::size_t, std::size_t>> border(double alpha_m) const {
        std::map<std::size_t, std::size_t> next;
        for (const auto& face : mesh_.finite_face_handles()) {
            if (!fits(face, alpha_m)) continue;
            for (int i = 0; i < 3; ++i) {
                if (fits(face->neighbor(i), alpha_m)) continue;
                const std::size_t from = face->vertex(Mesh::ccw(i))->info();
                if (!next.emplace(from, face->vertex(Mesh::cw(i))->info()).second) {
                    return std::nullopt;
                }
            }
        }
        return next;
    }

private:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
    using Faces = CGAL::Triangulation_face_base_with_info_2<double, Kernel>;
    using Mesh =
        CGAL::Delaunay_triangulation_2<Kernel,
                                       CGAL::Triangulation_data_structure_2<Vertices, Faces>>;

    /// Of the circumscribed circle; infinite where the corners lie in line as far as doubles tell,
    /// which the exact predicates behind the triangulation need not agree with.
    static double radius_m(const Mesh::Face_handle& face) {
        const auto &p = face->vertex(0)->point(), &q = face->vertex(1)->point(),
                   &r = face->vertex(2)->point();
        const auto a = q - p, b = r - p;
        if (CGAL::determinant(a.x(), a.y(), b.x(), b.y()) == 0.0) {
            return std::numeric_limits<double>::infinity();
        }
        return std::sqrt(CGAL::squared_radius(p, q, r));
    }

    bool fits(const Mesh::Face_handle& face, double alpha_m) const {
        return !mesh_.is_infinite(face) && face->info() <= alpha_m;
    }
    Mesh mesh_;
};

/// The loops of a border, each from its point of lowest index.
std::vector<Loop> loops_of(std::map<std::size_t, std::size_t> next,
                           std::span<const Eigen::Vector2d> points) {
    std::vector<Loop> loops;
    while (!next.empty()) {
        Loop& loop = loops.emplace_back();
        for (auto at = next.begin(); at != next.end();) {
            const std::size_t to = at->second;
            // cppcheck-suppress invalidContainerReference ; taken anew after each emplace_back
            loop.push_back(points[at->first]);
            next.erase(at);
            at = next.find(to);
        }
    }
    return loops;
}

double signed_area_m2(const Loop& loop) {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d a = loop[i] - loop[0];
        const Eigen::Vector2d b = loop[(i + 1) % loop.size()] - loop[0];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
}

ConcaveHull normalise(std::vector<Loop> loops) {
    std::vector<std::pair<double, Loop>> by_area;
    for (Loop& loop : loops) {
        const double area_m2 = signed_area_m2(loop);
        if (area_m2 < 0.0) std::ranges::reverse(loop);
        std::rotate(loop.begin(), std::ranges::min_element(loop, lexicographic_less), loop.end());
        by_area.emplace_back(std::abs(area_m2), std::move(loop));
    }
    std::ranges::sort(by_area, [](const auto& a, const auto& b) {
        if (a.first != b.first) return a.first > b.first;
        return lexicographic_less(a.second.front(), b.second.front());
    });
    ConcaveHull hull;
    hull.outline = std::move(by_area.front().second);
    for (std::size_t i = 1; i < by_area.size(); ++i) {
        hull.other_loops.push_back(std::move(by_area[i].second));
    }
    return hull;
}

std::optional<PlanError> check_input(std::span<const Eigen::Vector2d> points, double spacing_m,
                                     const ConcaveHullConfig& config) {
    if (auto bad = validate(config, "concave_hull.")) return bad;
    if (auto bad = check_positive("concave_hull: spacing_m", spacing_m)) return bad;
    return check_finite("concave_hull: points", points);
}

}  // namespace

Result<ConcaveHull> concave_hull(std::span<const Eigen::Vector2d> points, double spacing_m,
                                 const ConcaveHullConfig& config) {
    if (auto bad = check_input(points, spacing_m, config)) return *bad;
    const auto kept = thin_out(points, kLeastGap_spacings * spacing_m);
    if (kept.size() < 4) {
        return degenerate(std::to_string(kept.size()) + " distinct points, at least 4 are needed");
    }
    if (thickness_m(kept) < kLeastThickness_spacings * spacing_m) {
        return degenerate("all " + std::to_string(kept.size()) + " points lie on one line");
    }
    const Triangulation triangles(kept);
    double alpha_spacings = config.alpha_spacings;
    for (int growth = 0; growth <= kMaxGrowths; ++growth, alpha_spacings *= kAlphaGrowth) {
        const auto border = triangles.border(alpha_spacings * spacing_m);
        if (!border) continue;
        if (!border->empty()) return normalise(loops_of(*border, kept));
        std::ostringstream text;
        text << "no triangle of the " << kept.size()
             << " points fits alpha = " << alpha_spacings * spacing_m << " m";
        return degenerate(text.str());
    }
    std::ostringstream text;
    text << "the outline stays pinched up to " << std::pow(kAlphaGrowth, kMaxGrowths)
         << " times alpha_spacings = " << config.alpha_spacings;
    return degenerate(text.str());
}

}  // namespace graspd
