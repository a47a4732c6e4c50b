#include "convex_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace graspd::collision_detail {
namespace {

using Eigen::Vector3d;

/// Up to four points and the one of their hull that is nearest to the origin.
struct Simplex {
    std::array<Vector3d, 4> corners{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(),
                                    Vector3d::Zero()};  // those beyond count repeat others
    std::size_t count = 0;
    Vector3d nearest = Vector3d::Zero();
};

Simplex of_point(const Vector3d& a) {
    return {{a, a, a, a}, 1, a};
}

Simplex of_segment(const Vector3d& a, const Vector3d& b) {
    const Vector3d way = b - a;
    const double t = -a.dot(way), all = way.squaredNorm();
    if (t <= 0.0) return of_point(a);
    if (t >= all) return of_point(b);
    return {{a, b, b, b}, 2, a + (t / all) * way};
}

/// By its edges, and by its inner part where the origin stands over it.
Simplex of_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Simplex edges[] = {of_segment(a, b), of_segment(b, c), of_segment(c, a)};
    Simplex best = *std::ranges::min_element(
        edges, {}, [](const Simplex& edge) { return edge.nearest.squaredNorm(); });
    const Vector3d normal = (b - a).cross(c - a);
    const double area = normal.squaredNorm();
    const bool over = normal.dot((b - a).cross(-a)) > 0.0 && normal.dot((c - b).cross(-b)) > 0.0 &&
                      normal.dot((a - c).cross(-c)) > 0.0;
    if (!over || !(area > 0.0)) return best;
    const Vector3d foot = (a.dot(normal) / area) * normal;
    if (foot.squaredNorm() < best.nearest.squaredNorm()) best = {{a, b, c, c}, 3, foot};
    return best;
}

/// By its sides; the origin inside gives zero.
Simplex of_tetrahedron(const std::array<Vector3d, 4>& p) {
    constexpr std::array<std::array<std::size_t, 4>, 4> kSides = {
        {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    Simplex best;
    double least = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (const auto& side : kSides) {
        const Vector3d &a = p[side[0]], &b = p[side[1]], &c = p[side[2]];
        const Vector3d normal = (b - a).cross(c - a);
        inside = inside && normal.dot(p[side[3]] - a) * normal.dot(-a) > 0.0;
        const Simplex simplex = of_triangle(a, b, c);
        if (simplex.nearest.squaredNorm() < least) {
            best = simplex;
            least = simplex.nearest.squaredNorm();
        }
    }
    if (inside) best.nearest.setZero();
    return best;
}

Simplex with_corner(const Simplex& simplex, const Vector3d& corner) {
    const auto& p = simplex.corners;
    switch (simplex.count) {
        case 1: return of_segment(p[0], corner);
        case 2: return of_triangle(p[0], p[1], corner);
        default: return of_tetrahedron({p[0], p[1], p[2], corner});
    }
}

const Vector3d& farthest(std::span<const Vector3d> points, const Vector3d& direction) {
    return *std::ranges::max_element(points, {},
                                     [&](const Vector3d& p) { return p.dot(direction); });
}

}  // namespace

double distance_m(std::span<const Vector3d> a, std::span<const Vector3d> b, double most_m) {
    constexpr double kExact_m = 1e-9;
    constexpr int kMostSteps = 200;
    Simplex simplex = of_point(a.front() - b.front());
    for (int step = 0; step < kMostSteps; ++step) {
        const double upper_m = simplex.nearest.norm();
        if (upper_m <= kExact_m) return 0.0;
        const Vector3d toward = -simplex.nearest;
        const Vector3d support = farthest(a, toward) - farthest(b, -toward);
        const double lower_m = simplex.nearest.dot(support) / upper_m;
        if (lower_m >= most_m) return most_m;
        if (upper_m - lower_m <= kExact_m) break;
        const Simplex next = with_corner(simplex, support);
        if (!(next.nearest.squaredNorm() < simplex.nearest.squaredNorm())) break;  // rounding
        simplex = next;
    }
    return std::min(most_m, simplex.nearest.norm());
}

}  // namespace graspd::collision_detail
