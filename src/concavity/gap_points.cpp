#include "gap_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>

#include "graspd/base/stop.hpp"
#include "graspd/base/stoppable_sort.hpp"

namespace graspd::concavity_detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// In cells. A grid without jitter has cospherical points everywhere, which the triangulation would
// have to break by exact arithmetic; the other figures were found by trial (docs/concavity.md).
constexpr double kJitter = 0.3;
constexpr double kLeastToSurface = 0.5;
constexpr double kLeastToHull = 0.3;
constexpr double kAreaPerHullPoint = 0.43;
constexpr double kLeastGap = 0.01;  // thinner gaps are left closed
constexpr double kFreeShare = 0.9;  // [1] of a vertex's depth that is free around its foot
constexpr double kOnPlane = 1e-9;   // [1] of the diagonal: rounding of coordinates on a hull facet

double segment_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const Vector3d ab = b - a;
    const double t = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
    return (p - a - t * ab).norm();
}

/// From a point to a triangle with area [m].
double triangle_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                         const Vector3d& c) {
    const Vector3d normal = (b - a).cross(c - a).stableNormalized();
    const auto inside_of = [&](const Vector3d& from, const Vector3d& to) {
        return normal.dot((to - from).cross(p - from)) >= 0.0;
    };
    if (inside_of(a, b) && inside_of(b, c) && inside_of(c, a)) return std::abs(normal.dot(p - a));
    return std::min(
        {segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

/// One point set in the making.
class GapPoints {
public:
    GapPoints(const TriangleMesh& mesh, const OuterHull& hull, const TriangleBvh& bvh,
              double cell_m, const WorkLimits& limits)
        : mesh_(mesh),
          hull_(hull),
          bvh_(bvh),
          planes_(hull),
          limits_(limits),
          cell_m_(cell_m),
          random_(limits.config().seed) {
        for (const std::uint32_t v : hull.vertices) box_.extend(mesh.vertices[v]);
    }

    std::optional<PlanError> add_inside();
    std::optional<PlanError> add_on_facet(const HullFacet& facet);
    std::optional<PlanError> add_above_vertices();
    std::vector<Vector3d> take() { return std::move(points_); }

private:
    /// In [-1, 1); spelled out, as the standard's distributions differ between libraries.
    double draw() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0; }

    bool near_surface(const Vector3d& point, double within_m) const;
    bool in_gap(const Vector3d& point) const;
    std::vector<Vector2d> outline(const HullFacet& facet, const Eigen::Matrix<double, 3, 2>& axes,
                                  const Vector3d& origin) const;

    const TriangleMesh& mesh_;
    const OuterHull& hull_;
    const TriangleBvh& bvh_;
    HullPlaneTree planes_;
    const WorkLimits& limits_;
    double cell_m_;
    Eigen::AlignedBox3d box_;  ///< [m] of the hull
    std::mt19937_64 random_;
    std::vector<Vector3d> points_;
};

bool GapPoints::near_surface(const Vector3d& point, double within_m) const {
    OrientedBox box;
    box.pose.translation() = point;
    return std::ranges::any_of(bvh_.faces_near(box, within_m), [&](std::uint32_t f) {
        const Triangle& t = mesh_.faces[f];
        return triangle_distance(point, mesh_.vertices[t[0]], mesh_.vertices[t[1]],
                                 mesh_.vertices[t[2]]) < within_m;
    });
}

bool GapPoints::in_gap(const Vector3d& point) const {
    return planes_.nearest(point).distance_m > kLeastToHull * cell_m_ &&
           !near_surface(point, kLeastToSurface * cell_m_) && !bvh_.contains(point);
}

std::optional<PlanError> GapPoints::add_inside() {
    const Eigen::Vector3i size = (box_.sizes() / cell_m_).array().ceil().cast<int>();
    for (int i = 0; i < size.x(); ++i) {
        for (int j = 0; j < size.y(); ++j) {
            if (auto error = limits_.exceeded(kCellsPerPoint * points_.size())) return error;
            for (int k = 0; k < size.z(); ++k) {
                const double dx = draw(), dy = draw(), dz = draw();
                const Vector3d place = Vector3d(i, j, k) + kJitter * Vector3d(dx, dy, dz);
                const Vector3d point =
                    box_.min() + cell_m_ * (place + Vector3d::Constant(0.5)).eval();
                if (in_gap(point)) points_.push_back(point);
            }
        }
    }
    return std::nullopt;
}

/// Corners of a facet counter-clockwise, in the plane's axes.
std::vector<Vector2d> GapPoints::outline(const HullFacet& facet,
                                         const Eigen::Matrix<double, 3, 2>& axes,
                                         const Vector3d& origin) const {
    const double near_m = kOnPlane * box_.diagonal().norm();
    std::vector<Vector2d> corners;
    Vector2d middle = Vector2d::Zero();
    std::size_t step = 0;
    for (const std::uint32_t v : hull_.vertices) {
        stop_point(step++);
        const Vector3d& p = mesh_.vertices[v];
        if (std::abs(facet.normal.dot(p) - facet.offset_m) > near_m) continue;
        corners.emplace_back(axes.transpose() * (p - origin));
        middle += corners.back();
    }
    if (corners.empty()) return corners;
    middle /= static_cast<double>(corners.size());
    const auto angle = [&](const Vector2d& c) {
        return std::atan2(c.y() - middle.y(), c.x() - middle.x());
    };
    std::ranges::sort(corners, {}, angle);
    return corners;
}

bool inside_outline(const std::vector<Vector2d>& corners, const Vector2d& p) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
        const Vector2d to = p - corners[i];
        if (side.x() * to.y() - side.y() * to.x() < 0.0) return false;
    }
    return true;
}

/// A jittered grid whose phase is random, so that facets smaller than its cells get their share.
std::optional<PlanError> GapPoints::add_on_facet(const HullFacet& facet) {
    const double spacing_m = std::sqrt(kAreaPerHullPoint) * cell_m_;
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = facet.normal.unitOrthogonal();
    axes.col(1) = facet.normal.cross(axes.col(0));
    const Vector3d center = facet.box.center();
    const Vector3d origin = center + (facet.offset_m - facet.normal.dot(center)) * facet.normal;
    const std::vector<Vector2d> corners = outline(facet, axes, origin);
    Eigen::AlignedBox2d area;
    for (const Vector2d& c : corners) area.extend(c);
    const double phase_x = draw(), phase_y = draw();
    if (corners.size() < 3) return std::nullopt;
    const Vector2d begin = area.min() - 0.5 * spacing_m * Vector2d(1.0 + phase_x, 1.0 + phase_y);
    const Eigen::Vector2i size = ((area.max() - begin) / spacing_m).array().ceil().cast<int>();
    for (int i = 0; i < size.x(); ++i) {
        if (auto error = limits_.exceeded(kCellsPerPoint * points_.size())) return error;
        for (int j = 0; j < size.y(); ++j) {
            const double dx = draw(), dy = draw();
            const Vector2d place = Vector2d(i + 0.5, j + 0.5) + kJitter * Vector2d(dx, dy);
            const Vector2d p = begin + spacing_m * place;
            if (!inside_outline(corners, p)) continue;
            const Vector3d point = origin + axes * p;
            if (!near_surface(point, kLeastToSurface * cell_m_)) points_.push_back(point);
        }
    }
    return std::nullopt;
}

/// In a gap thinner than the cells no point of a grid keeps its distance, and the way out would end
/// at the gap's rim. So the hull gets a point straight above each vertex of such a gap: it breaks
/// no face, as it lies outside the least sphere around any face at its vertex.
std::optional<PlanError> GapPoints::add_above_vertices() {
    std::vector<std::uint32_t> used;
    for (const Triangle& t : mesh_.faces) used.insert(used.end(), t.begin(), t.end());
    stoppable_sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::size_t step = 0;
    for (const std::uint32_t v : used) {
        stop_point(step++);
        const Vector3d& vertex = mesh_.vertices[v];
        const HullPlaneTree::Nearest nearest = planes_.nearest(vertex);
        const double depth_m = nearest.distance_m;
        if (depth_m < kLeastGap * cell_m_ || depth_m > cell_m_) continue;
        const Vector3d foot = vertex + depth_m * planes_.facet(nearest.facet).normal;
        if (!near_surface(foot, kFreeShare * depth_m)) points_.push_back(foot);
    }
    return limits_.exceeded(kCellsPerPoint * points_.size());
}

}  // namespace

Result<std::vector<Vector3d>> gap_points(const TriangleMesh& mesh, const OuterHull& hull,
                                         const TriangleBvh& bvh, double cell_m,
                                         const WorkLimits& limits) {
    GapPoints points(mesh, hull, bvh, cell_m, limits);
    if (auto error = points.add_inside()) return *std::move(error);
    for (const HullFacet& facet : hull.facets) {
        if (auto error = points.add_on_facet(facet)) return *std::move(error);
    }
    if (auto error = points.add_above_vertices()) return *std::move(error);
    return points.take();
}

}  // namespace graspd::concavity_detail
