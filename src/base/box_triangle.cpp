#include "graspd/base/box_triangle.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace graspd {
namespace {

using Eigen::Vector3d;

/// A box that moves along a way, and a triangle in its axes.
struct Pair {
    const Vector3d& half;
    const Vector3d& half_way;
    const std::array<Vector3d, 3>& triangle;

    /// How far the solid reaches along an axis, times the axis' length.
    double reach(const Vector3d& axis) const {
        return half.dot(axis.cwiseAbs()) + std::abs(half_way.dot(axis));
    }
    bool parted_by(const Vector3d& axis) const {
        const double a = triangle[0].dot(axis), b = triangle[1].dot(axis),
                     c = triangle[2].dot(axis);
        return std::max(std::min({a, b, c}), -std::max({a, b, c})) > reach(axis);
    }
    /// The same for an axis that is upright on an edge, whose two corners share one place on it.
    bool parted_by(const Vector3d& axis, const Vector3d& on_edge, const Vector3d& opposite) const {
        const double a = on_edge.dot(axis), b = opposite.dot(axis);
        return std::max(std::min(a, b), -std::max(a, b)) > reach(axis);
    }
};

/// By the axes of the box's edges, the triangle's normal, and their products.
bool parted_at_rest(const Pair& pair) {
    const auto& t = pair.triangle;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const double low = std::min({t[0][k], t[1][k], t[2][k]});
        const double high = std::max({t[0][k], t[1][k], t[2][k]});
        if (std::max(low, -high) > pair.half[k] + std::abs(pair.half_way[k])) return true;
    }
    // An axis without accuracy, as of a needle or of parallel edges, still judges rightly when all
    // three corners are laid on it.
    if (pair.parted_by((t[1] - t[0]).cross(t[2] - t[0]))) return true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d edge = t[(i + 1) % 3] - t[i];
        const Vector3d& opposite = t[(i + 2) % 3];
        const Vector3d products[] = {
            {0.0, -edge.z(), edge.y()}, {edge.z(), 0.0, -edge.x()}, {-edge.y(), edge.x(), 0.0}};
        for (const Vector3d& axis : products) {
            if (pair.parted_by(axis, t[i], opposite)) return true;
        }
    }
    return false;
}

/// By the products with the direction of the way.
bool parted_on_the_way(const Pair& pair) {
    const auto& t = pair.triangle;
    for (Eigen::Index k = 0; k < 3; ++k) {
        if (pair.parted_by(pair.half_way.cross(Vector3d::Unit(k)))) return true;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (pair.parted_by(pair.half_way.cross(t[(i + 1) % 3] - t[i]))) return true;
    }
    return false;
}

}  // namespace

bool box_meets_triangle(const Vector3d& half, const Vector3d& half_way,
                        const std::array<Vector3d, 3>& triangle) {
    const Pair pair{half, half_way, triangle};
    return !parted_at_rest(pair) && (half_way.isZero(0.0) || !parted_on_the_way(pair));
}

}  // namespace graspd
