#include <cmath>
#include <numeric>

#include "object_parsers.hpp"

namespace graspd::mesh_detail {
namespace {

// Cutting ears is quadratic or worse; no modeller writes concave polygons of more corners.
constexpr std::size_t kMostEarCorners = 512;

Eigen::Vector2d drop_axis(const Eigen::Vector3d& p, int axis, bool mirror) {
    const Eigen::Vector2d flat(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    return mirror ? Eigen::Vector2d(flat.y(), flat.x()) : flat;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The polygon seen along the axis nearest to its normal (Newell's), counter-clockwise.
std::vector<Eigen::Vector2d> flatten(const std::vector<Eigen::Vector3d>& points,
                                     const std::vector<std::uint32_t>& polygon) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const Eigen::Vector3d& base = points[polygon[0]];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector3d a = points[polygon[i]] - base;
        const Eigen::Vector3d b = points[polygon[(i + 1) % polygon.size()]] - base;
        normal += a.cross(b);
    }
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    std::vector<Eigen::Vector2d> flat;
    for (const std::uint32_t i : polygon) {
        flat.push_back(drop_axis(points[i], axis, normal[axis] < 0.0));
    }
    return flat;
}

bool is_convex(const std::vector<Eigen::Vector2d>& flat) {
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (!(turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) >= 0.0)) return false;
    }
    return true;
}

/// Whether corner `at` of the remaining polygon can be cut off: convex, with no other corner in it.
bool is_ear(const std::vector<Eigen::Vector2d>& flat, const std::vector<std::size_t>& left,
            std::size_t at) {
    const std::size_t n = left.size();
    const Eigen::Vector2d& a = flat[left[(at + n - 1) % n]];
    const Eigen::Vector2d& b = flat[left[at]];
    const Eigen::Vector2d& c = flat[left[(at + 1) % n]];
    if (!(turn(a, b, c) > 0.0)) return false;
    for (std::size_t k = 2; k + 1 < n; ++k) {
        const Eigen::Vector2d& p = flat[left[(at + k) % n]];
        if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
}

}  // namespace

void triangulate_polygon(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<std::uint32_t>& polygon,
                         std::vector<Triangle>& triangles) {
    std::vector<std::size_t> left(polygon.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    if (polygon.size() > 3 && polygon.size() <= kMostEarCorners) {
        const std::vector<Eigen::Vector2d> flat = flatten(points, polygon);
        bool cut = !is_convex(flat);
        while (cut && left.size() > 3) {
            cut = false;
            for (std::size_t at = 0; at < left.size() && !cut; ++at) {
                if (!is_ear(flat, left, at)) continue;
                const std::size_t n = left.size();
                triangles.push_back({polygon[left[(at + n - 1) % n]], polygon[left[at]],
                                     polygon[left[(at + 1) % n]]});
                left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
                cut = true;
            }
        }
    }
    for (std::size_t k = 2; k < left.size(); ++k) {  // a fan, of what has no ear (more) too
        triangles.push_back({polygon[left[0]], polygon[left[k - 1]], polygon[left[k]]});
    }
}

}  // namespace graspd::mesh_detail
