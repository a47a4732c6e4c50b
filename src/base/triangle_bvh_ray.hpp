#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "graspd/base/lanes.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

inline double longest_edge(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    return std::sqrt(
        std::max({edge1.squaredNorm(), edge2.squaredNorm(), (edge2 - edge1).squaredNorm()}));
}

/// A ray in double precision for the triangles that are close, and in the tree's units.
struct TriangleBvh::Ray {
    /// For what single precision rounds a length by.
    static constexpr float kSlack = 1.0F + 1e-6F;

    Eigen::Vector3d origin, direction;
    Eigen::Vector3d unit, inverted;  ///< of unit length; one over each of its coordinates
    double units_per_t = 0.0;        ///< length of `direction` in the tree's units
    double skipped = 0.0;            ///< [units] from the origin to where the ray enters the bounds
    bool has_direction = false, meets_bounds = false;
    std::array<Eigen::Array4f, 3> start, along, inverse;  ///< [units] from there; of unit length
    std::array<std::size_t, 3> near_side{};  ///< of a box along each axis: 0 low, 1 high

    Ray(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const TriangleBvh& bvh)
        : Ray(to, bvh) {
        start_at(from, bvh);
    }
    /// From nowhere yet: see start_at().
    Ray(const Eigen::Vector3d& to, const TriangleBvh& bvh) : direction(to) {
        for (auto* each : {&start, &along, &inverse}) each->fill(Eigen::Array4f::Zero());
        const double length_m = to.norm();
        if (bvh.packs_.empty() || !(length_m > 0.0)) return;
        has_direction = true;
        units_per_t = length_m * bvh.units_per_m_;
        // Directions as good as zero count as a huge finite inverse: infinity times 0 is no number.
        constexpr double kLeast = 1e-30;
        unit = direction * (1.0 / length_m);
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            inverted[axis] = std::abs(unit[axis]) > kLeast ? 1.0 / unit[axis] : 1.0 / kLeast;
            const auto a = static_cast<std::size_t>(axis);
            inverse[a].setConstant(static_cast<float>(inverted[axis]));
            along[a].setConstant(static_cast<float>(unit[axis]));
            near_side[a] = inverted[axis] < 0.0;
        }
    }
    void start_at(const Eigen::Vector3d& from, const TriangleBvh& bvh) {
        origin = from;
        skipped = 0.0;
        if (!has_direction) return;
        meets_bounds = bvh.bounds_.contains(from) || enter_bounds(bvh);
        if (!meets_bounds) return;
        const Eigen::Vector3d entry = (from - bvh.middle_) * bvh.units_per_m_ + skipped * unit;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start[axis].setConstant(static_cast<float>(entry[static_cast<Eigen::Index>(axis)]));
        }
    }

    /// From outside: skips what lies before the bounds. @return whether the ray comes into them
    bool enter_bounds(const TriangleBvh& bvh) {
        const Eigen::Array3d to_units = inverted.array() * bvh.units_per_m_;
        const Eigen::Array3d low = (bvh.bounds_.min() - origin).array() * to_units;
        const Eigen::Array3d high = (bvh.bounds_.max() - origin).array() * to_units;
        skipped = std::max(0.0, low.min(high).maxCoeff());
        return skipped <= low.max(high).minCoeff() * (1.0 + 1e-12);
    }

    /// From the start within the bounds to t = reach [units].
    float units_to(double reach) const {
        constexpr double kBeyond = 4.0;  // the bounds are a unit across
        return static_cast<float>(std::min(reach * units_per_t - skipped, kBeyond)) * kSlack;
    }

    /// Which children's boxes the ray enters within `reach`, and where.
    unsigned enters(const BoxTree::Node& node, float reach, Eigen::Array4f& enter) const {
        enter = Eigen::Array4f::Zero();
        Eigen::Array4f leave = Eigen::Array4f::Constant(reach);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& bound = node.bound[axis];
            enter = enter.max((bound[near_side[axis]] - start[axis]) * inverse[axis]);
            leave = leave.min((bound[1 - near_side[axis]] - start[axis]) * inverse[axis]);
        }
        return lanes_not_negative(leave * kSlack - enter);
    }
};

/// Moller-Trumbore four times over, without the division, with the triangles' normals at hand. Each
/// product's rounding is below a small multiple of 6e-8 times its factors' lengths, and no factor
/// but the triangle's edges exceeds 1.
inline unsigned TriangleBvh::near_lanes(const Ray& ray, const Pack& pack, float reach,
                                        float margin) {
    const auto& d = ray.along;
    const std::array<Eigen::Array4f, 3> s{pack.origin[0] - ray.start[0],
                                          pack.origin[1] - ray.start[1],
                                          pack.origin[2] - ray.start[2]};
    const std::array<Eigen::Array4f, 3> r{s[1] * d[2] - s[2] * d[1], s[2] * d[0] - s[0] * d[2],
                                          s[0] * d[1] - s[1] * d[0]};
    const auto dot = [](const auto& a, const auto& b) -> Eigen::Array4f {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const Eigen::Array4f determinant = dot(d, pack.normal);
    const Eigen::Array4f size = determinant.abs();
    const Eigen::Array4f minus_u = lanes_turned(dot(r, pack.edge2), determinant);
    const Eigen::Array4f v = lanes_turned(dot(r, pack.edge1), determinant);
    const Eigen::Array4f t = lanes_turned(dot(s, pack.normal), determinant);
    const Eigen::Array4f beside = margin * pack.longest;
    const Eigen::Array4f beyond = kRounding * pack.longest * pack.longest.abs();
    return lanes_not_negative(v.min(-minus_u).min(size + minus_u - v) + beside) &
           lanes_not_negative(t.min(reach * size - t) + beyond);
}

}  // namespace graspd
