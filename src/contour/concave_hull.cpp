#include "graspd/contour/concave_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <sstream>
#include <utility>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/concave_hull.h>
#include <Eigen/Eigenvalues>
#include <pcl/surface/impl/concave_hull.hpp>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

using Loop = std::vector<Eigen::Vector2d>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

// Nearer points say nothing new about an outline along which a disc of a spacing or more rolls.
constexpr double kLeastGap_spacings = 0.25;
// Thinner sets have no triangle whose circumscribed circle fits any alpha; qhull would complain.
constexpr double kLeastThickness_spacings = 1e-3;
constexpr double kAlphaGrowth = 1.15;
constexpr int kMaxGrowths = 10;  // 4 times the configured alpha: no longer the shape asked for

PlanError degenerate(const std::string& detail) {
    return PlanError{PlanErrorCode::kDegenerate, "concave_hull: " + detail};
}

/// Sorted points of which no two are nearer than `least_gap_m`.
std::vector<Eigen::Vector2d> thin_out(std::span<const Eigen::Vector2d> points, double least_gap_m) {
    std::vector<Eigen::Vector2d> sorted(points.begin(), points.end());
    std::ranges::sort(sorted, lexicographic_less);
    std::vector<Eigen::Vector2d> kept;
    for (const Eigen::Vector2d& point : sorted) {
        bool is_free = true;
        for (std::size_t k = kept.size(); is_free && k-- > 0;) {
            if (point.x() - kept[k].x() >= least_gap_m) break;
            is_free = (point - kept[k]).norm() >= least_gap_m;
        }
        if (is_free) kept.push_back(point);
    }
    return kept;
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

/// PCL works in float: centred and in spacings, so that no digits are lost far from the origin.
Cloud::Ptr in_spacings(std::span<const Eigen::Vector2d> points, double spacing_m) {
    const Eigen::Vector2d mean = mean_of(points);
    auto cloud = pcl::make_shared<Cloud>();
    cloud->reserve(points.size());
    for (const Eigen::Vector2d& point : points) {
        const Eigen::Vector2f scaled = ((point - mean) / spacing_m).cast<float>();
        cloud->push_back(pcl::PointXYZ(scaled.x(), scaled.y(), 0.0F));
    }
    return cloud;
}

/// What PCL's walk along the alpha shape's edges brought home.
struct Walk {
    std::vector<Loop> loops;  ///< the input's own points
    bool is_whole = true;     ///< every vertex is in a loop, and no loop closes by a false edge
};

Walk walk_outline(const Cloud::Ptr& cloud, std::span<const Eigen::Vector2d> points,
                  double alpha_spacings, double spacing_m) {
    pcl::ConcaveHull<pcl::PointXYZ> hull;
    hull.setInputCloud(cloud);
    hull.setDimension(2);
    hull.setAlpha(alpha_spacings);
    hull.setKeepInformation(true);
    Cloud vertices;
    std::vector<pcl::Vertices> polygons;
    hull.reconstruct(vertices, polygons);
    pcl::PointIndices source;
    hull.getHullPointIndices(source);

    Walk walk;
    std::size_t walked = 0;
    // An edge of the shape is a chord of a circle that fits alpha.
    const double longest_edge_m = 2.0 * alpha_spacings * spacing_m * (1.0 + 1e-4);
    for (const pcl::Vertices& polygon : polygons) {
        Loop loop;
        for (const auto vertex : polygon.vertices) {
            loop.push_back(points[static_cast<std::size_t>(source.indices[vertex])]);
        }
        walked += loop.size();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const double edge_m = (loop[(i + 1) % loop.size()] - loop[i]).norm();
            walk.is_whole = walk.is_whole && edge_m <= longest_edge_m;
        }
        walk.loops.push_back(std::move(loop));
    }
    walk.is_whole = walk.is_whole && walked == vertices.size();
    return walk;
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
    try {
        const Cloud::Ptr cloud = in_spacings(kept, spacing_m);
        double alpha_spacings = config.alpha_spacings;
        for (int growth = 0; growth <= kMaxGrowths; ++growth, alpha_spacings *= kAlphaGrowth) {
            Walk walk = walk_outline(cloud, kept, alpha_spacings, spacing_m);
            if (!walk.is_whole) continue;
            if (!walk.loops.empty()) return normalise(std::move(walk.loops));
            std::ostringstream text;
            text << "no triangle of the " << kept.size()
                 << " points fits alpha = " << alpha_spacings * spacing_m << " m";
            return degenerate(text.str());
        }
    } catch (const std::exception& error) {
        return PlanError{PlanErrorCode::kInternal,
                         std::string("concave_hull: PCL failed: ") + error.what()};
    }
    std::ostringstream text;
    text << "the outline stays pinched up to " << std::pow(kAlphaGrowth, kMaxGrowths)
         << " times alpha_spacings = " << config.alpha_spacings;
    return degenerate(text.str());
}

}  // namespace graspd
