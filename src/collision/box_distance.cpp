#include "box_distance.hpp"

#include <algorithm>
#include <cmath>

namespace graspd::collision_detail {
namespace {

using Eigen::Vector3d;

/// Squared distance from a point to the box that spans [-half, half].
double squared_distance(const Vector3d& point, const Vector3d& half) {
    return (point.cwiseAbs() - half).cwiseMax(0.0).squaredNorm();
}

/// The same from the segment a + t (b - a), t in [0, 1]: a convex function of t, whose derivative
/// is linear between the places where the segment crosses the planes of the box's faces.
double squared_distance(const Vector3d& a, const Vector3d& b, const Vector3d& half) {
    const Vector3d way = b - a;
    const auto slope = [&](double t) {  // half the derivative
        const Vector3d point = a + t * way;
        const Vector3d beyond = point - point.cwiseMax(-half).cwiseMin(half);
        return beyond.dot(way);
    };
    double low = 0.0, high = 1.0, slope_low = slope(0.0), slope_high = slope(1.0);
    if (slope_low >= 0.0) return squared_distance(a, half);
    if (slope_high <= 0.0) return squared_distance(b, half);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) continue;
        for (const double side : {-half[axis], half[axis]}) {
            const double t = (side - a[axis]) / way[axis];
            if (!(t > low && t < high)) continue;
            const double here = slope(t);
            (here < 0.0 ? low : high) = t;
            (here < 0.0 ? slope_low : slope_high) = here;
        }
    }
    const double least = low + (high - low) * slope_low / (slope_low - slope_high);
    return squared_distance(a + least * way, half);
}

/// Whether a point of the triangle's plane lies in the triangle.
bool holds(const Corners& triangle, const Vector3d& normal, const Vector3d& point) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d& corner = triangle[i];
        if (normal.dot((triangle[(i + 1) % 3] - corner).cross(point - corner)) < 0.0) return false;
    }
    return true;
}

/// Squared distance between the box's corners and the inner part of the triangle; 0 where the box
/// passes through it; `most` when neither is the nearest place.
double squared_distance_inside(const Corners& triangle, const Vector3d& half, double most) {
    const Vector3d normal =
        (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
    Vector3d lowest = half, highest = half;
    double low = normal.dot(half - triangle[0]), high = low, least = most;
    for (unsigned k = 0; k < 8; ++k) {
        const Vector3d corner((k & 1u) != 0 ? half.x() : -half.x(),
                              (k & 2u) != 0 ? half.y() : -half.y(),
                              (k & 4u) != 0 ? half.z() : -half.z());
        const double height = normal.dot(corner - triangle[0]);
        if (height < low) {
            low = height;
            lowest = corner;
        }
        if (height > high) {
            high = height;
            highest = corner;
        }
        if (height * height < least && holds(triangle, normal, corner - height * normal)) {
            least = height * height;
        }
    }
    if (low > 0.0 || high < 0.0 || low == high) return least;
    const Vector3d common = lowest + (highest - lowest) * (low / (low - high));
    return holds(triangle, normal, common) ? 0.0 : least;
}

}  // namespace

double distance_m(const OrientedBox& box, const Corners& triangle, double most_m) {
    const Vector3d& half = box.half_extent;
    const Eigen::Isometry3d to_box = box.pose.inverse(Eigen::Isometry);
    const Corners local{to_box * triangle[0], to_box * triangle[1], to_box * triangle[2]};
    const Vector3d low = local[0].cwiseMin(local[1]).cwiseMin(local[2]);
    const Vector3d high = local[0].cwiseMax(local[1]).cwiseMax(local[2]);
    const Vector3d apart = (low - half).cwiseMax(-half - high).cwiseMax(0.0);
    double least = most_m * most_m;
    if (apart.squaredNorm() >= least) return most_m;
    for (std::size_t i = 0; i < 3; ++i) {
        least = std::min(least, squared_distance(local[i], local[(i + 1) % 3], half));
    }
    return std::sqrt(squared_distance_inside(local, half, least));
}

double distance_m(const OrientedBox& a, const OrientedBox& b, double most_m) {
    const Vector3d center_in_a = a.pose.inverse(Eigen::Isometry) * b.pose.translation();
    if (squared_distance(center_in_a, a.half_extent) == 0.0) return 0.0;
    double least = most_m;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Vector3d& half = a.half_extent;
        const Vector3d u = half[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
        const Vector3d v = half[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
        for (const double side : {-1.0, 1.0}) {
            const Vector3d middle = side * half[axis] * Vector3d::Unit(axis);
            const Vector3d p = a.pose * (middle - u - v), q = a.pose * (middle + u + v);
            least = std::min(least, distance_m(b, {p, a.pose * (middle + u - v), q}, least));
            least = std::min(least, distance_m(b, {p, q, a.pose * (middle - u + v)}, least));
        }
    }
    return least;
}

}  // namespace graspd::collision_detail
