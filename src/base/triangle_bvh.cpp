#include "graspd/base/triangle_bvh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "graspd/base/lanes.hpp"

namespace graspd {
namespace {

// Single precision rounds by 6e-8; coordinates stay below 1, so three roundings fit in here.
constexpr float kPad = 5e-7F;
constexpr float kSlack = 1.0F + 1e-6F;
constexpr float kRounding = 2e-6F;  // of a triangle's products, over its longest edge's powers
constexpr float kNever = std::numeric_limits<float>::infinity();

double longest_edge(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    return std::sqrt(
        std::max({edge1.squaredNorm(), edge2.squaredNorm(), (edge2 - edge1).squaredNorm()}));
}

/// Twice the area over the longest edge.
double least_height(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    return edge1.cross(edge2).norm() / longest_edge(edge1, edge2);
}

bool has_area(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    return edge1.cross(edge2).squaredNorm() > 0.0;
}

/// Squared distance from a point to a segment that starts at the origin.
double squared_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& segment) {
    const double share = std::clamp(point.dot(segment) / segment.squaredNorm(), 0.0, 1.0);
    return (point - share * segment).squaredNorm();
}

}  // namespace

/// A ray in double precision for the triangles that are close, and in the tree's units.
struct TriangleBvh::Ray {
    Eigen::Vector3d origin, direction;
    double units_per_t = 0.0;  ///< length of `direction` in the tree's units
    double skipped = 0.0;      ///< [units] from the origin to where the ray enters the bounds
    bool meets_bounds = false;
    std::array<float, 3> start{}, along{}, inverse{};  ///< [units] from there; of unit length
    std::array<std::size_t, 3> near_side{};            ///< of a box along each axis: 0 low, 1 high

    Ray(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const TriangleBvh& bvh)
        : origin(from), direction(to), units_per_t(to.norm() / bvh.diagonal_m_) {
        if (bvh.packs_.empty() || !(units_per_t > 0.0)) return;
        // Directions as good as zero count as a huge finite inverse: infinity times 0 is no number.
        constexpr double kLeast = 1e-30;
        const Eigen::Vector3d unit = direction / direction.norm();
        double enter = 0.0, leave = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double inverted = std::abs(unit[axis]) > kLeast ? 1.0 / unit[axis] : 1.0 / kLeast;
            const double low = (bvh.bounds_.min()[axis] - from[axis]) / bvh.diagonal_m_ * inverted;
            const double high = (bvh.bounds_.max()[axis] - from[axis]) / bvh.diagonal_m_ * inverted;
            enter = std::max(enter, std::min(low, high));
            leave = std::min(leave, std::max(low, high));
            const auto a = static_cast<std::size_t>(axis);
            inverse[a] = static_cast<float>(inverted);
            along[a] = static_cast<float>(unit[axis]);
            near_side[a] = inverted < 0.0;
        }
        meets_bounds = enter <= leave * (1.0 + 1e-12);
        if (!meets_bounds) return;
        skipped = enter;
        const Eigen::Vector3d entry =
            (from - bvh.bounds_.center()) / bvh.diagonal_m_ + enter * unit;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start[axis] = static_cast<float>(entry[static_cast<Eigen::Index>(axis)]);
        }
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

TriangleBvh::TriangleBvh(const TriangleMesh& mesh, double tolerance_m)
    : tolerance_m_(tolerance_m), vertices_(mesh.vertices) {
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) bounds_.extend(mesh.vertices[vertex]);
    }
    if (bounds_.isEmpty()) return;
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(tolerance_m);
    bounds_ = Eigen::AlignedBox3d(bounds_.min() - pad, bounds_.max() + pad);
    diagonal_m_ = bounds_.diagonal().norm();
    const float pad_units = static_cast<float>(tolerance_m / diagonal_m_) + kPad;
    margin_ = static_cast<float>(tolerance_m / diagonal_m_) + kRounding;
    const Eigen::Vector3d middle = bounds_.center();
    std::vector<Eigen::Array4f> units(mesh.vertices.size(), Eigen::Array4f::Zero());
    for (std::size_t v = 0; v < units.size(); ++v) {
        units[v].head<3>() = ((mesh.vertices[v] - middle) / diagonal_m_).cast<float>();
    }
    std::vector<Box4f> boxes;
    boxes.reserve(mesh.faces.size());
    std::vector<std::uint32_t> solid;  // faces with an area
    solid.reserve(mesh.faces.size());
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        const Triangle& t = mesh.faces[face];
        const Eigen::Vector3d& origin = mesh.vertices[t[0]];
        if (!has_area(mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin)) continue;
        const Eigen::Array4f &a = units[t[0]], &b = units[t[1]], &c = units[t[2]];
        boxes.push_back({a.min(b).min(c) - pad_units, a.max(b).max(c) + pad_units});
        solid.push_back(face);
    }
    tree_ = build_box_tree(boxes);
    number_.reserve(solid.size());
    faces_.reserve(solid.size());
    for (const std::uint32_t place : tree_.order) {
        number_.push_back(solid[place]);
        faces_.push_back(mesh.faces[solid[place]]);
    }
    packs_.reserve(tree_.nodes.size() * 3 + 1);
    if (BoxTree::is_leaf(tree_.root)) add_pack(tree_.root);
    for (BoxTree::Node& node : tree_.nodes) {
        for (std::uint32_t& child : node.child) {
            if (BoxTree::is_leaf(child)) add_pack(child);
        }
    }
}

/// Lays a leaf's triangles side by side and lets the leaf name the pack.
void TriangleBvh::add_pack(std::uint32_t& leaf) {
    Pack pack;
    pack.first = BoxTree::leaf_first(leaf);
    pack.count = BoxTree::leaf_count(leaf);
    if (pack.count == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        pack.origin[axis] = pack.edge1[axis] = pack.edge2[axis] = Eigen::Array4f::Zero();
    }
    pack.longest = Eigen::Array4f::Constant(-1.0F);
    for (std::uint32_t k = 0; k < pack.count; ++k) {
        const Triangle& t = faces_[pack.first + k];
        const Eigen::Vector3d& corner = vertices_[t[0]];
        const Eigen::Vector3d origin = (corner - bounds_.center()) / diagonal_m_;
        const Eigen::Vector3d edge1 = (vertices_[t[1]] - corner) / diagonal_m_;
        const Eigen::Vector3d edge2 = (vertices_[t[2]] - corner) / diagonal_m_;
        const auto lane = static_cast<Eigen::Index>(k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            pack.origin[axis][lane] = static_cast<float>(origin[a]);
            pack.edge1[axis][lane] = static_cast<float>(edge1[a]);
            pack.edge2[axis][lane] = static_cast<float>(edge2[a]);
        }
        pack.longest[lane] = static_cast<float>(longest_edge(edge1, edge2));
    }
    leaf = BoxTree::kLeafBit | static_cast<std::uint32_t>(packs_.size()) << 3 | pack.count;
    packs_.push_back(pack);
}

/// Moller-Trumbore four times over, without the division. Each product's rounding is below a small
/// multiple of 6e-8 times its factors' lengths, and no factor but the triangle's edges exceeds 1.
unsigned TriangleBvh::near_lanes(const Ray& ray, const Pack& pack, float reach, float margin) {
    const auto& e1 = pack.edge1;
    const auto& e2 = pack.edge2;
    const auto& d = ray.along;
    const std::array<Eigen::Array4f, 3> s{ray.start[0] - pack.origin[0],
                                          ray.start[1] - pack.origin[1],
                                          ray.start[2] - pack.origin[2]};
    const std::array<Eigen::Array4f, 3> p{d[1] * e2[2] - d[2] * e2[1], d[2] * e2[0] - d[0] * e2[2],
                                          d[0] * e2[1] - d[1] * e2[0]};
    const std::array<Eigen::Array4f, 3> q{s[1] * e1[2] - s[2] * e1[1], s[2] * e1[0] - s[0] * e1[2],
                                          s[0] * e1[1] - s[1] * e1[0]};
    const Eigen::Array4f determinant = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];
    const Eigen::Array4f size = determinant.abs();
    const Eigen::Array4f sign = (determinant < 0.0F).select(Eigen::Array4f::Constant(-1.0F), 1.0F);
    const Eigen::Array4f u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) * sign;
    const Eigen::Array4f v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) * sign;
    const Eigen::Array4f t = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) * sign;
    const Eigen::Array4f beside = margin * pack.longest;
    const Eigen::Array4f beyond = kRounding * pack.longest * pack.longest.abs();
    return lanes_not_negative(u.min(v).min(size - u - v) + beside) &
           lanes_not_negative(t.min(reach * size - t) + beyond);
}

/// Moller-Trumbore; a hit beside the triangle counts within the tolerance of its edges.
bool TriangleBvh::meets(const Ray& ray, std::uint32_t place, double reach, Hit& hit) const {
    const Triangle& face = faces_[place];
    const Eigen::Vector3d& corner = vertices_[face[0]];
    const Eigen::Vector3d edge1 = vertices_[face[1]] - corner;
    const Eigen::Vector3d edge2 = vertices_[face[2]] - corner;
    const Eigen::Vector3d p = ray.direction.cross(edge2);
    const double determinant = edge1.dot(p);
    if (determinant == 0.0) return false;
    const double scale = 1.0 / determinant;
    const double tolerance = tolerance_m_ / least_height(edge1, edge2);
    const Eigen::Vector3d s = ray.origin - corner;
    const double u = s.dot(p) * scale;
    if (!(u >= -tolerance && u <= 1.0 + tolerance)) return false;
    const Eigen::Vector3d q = s.cross(edge1);
    const double v = ray.direction.dot(q) * scale;
    if (!(v >= -tolerance && u + v <= 1.0 + tolerance)) return false;
    const double t = edge2.dot(q) * scale;
    if (!(t >= 0.0 && t <= reach)) return false;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) {
        // A needle's barycentric tolerance alone would reach far beyond its ends.
        const Eigen::Vector3d at = u * edge1 + v * edge2;
        const double nearest = std::min({squared_distance(at, edge1), squared_distance(at, edge2),
                                         squared_distance(at - edge1, edge2 - edge1)});
        if (nearest > tolerance_m_ * tolerance_m_) return false;
    }
    hit = {t, number_[place], determinant > 0.0};
    return true;
}

template <bool kNearestFirst, class Visit>
void TriangleBvh::traverse(const Ray& ray, double& reach, Visit&& visit) const {
    if (!ray.meets_bounds) return;
    struct Waiting {
        std::uint32_t child;
        float enter;
    };
    std::array<Waiting, BoxTree::kStackDepth> stack;
    std::size_t top = 0;
    stack[top++] = {tree_.root, 0.0F};
    float left = ray.units_to(reach);
    while (top > 0) {
        const Waiting item = stack[--top];
        if (item.enter > left) continue;
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            unsigned lanes = near_lanes(ray, pack, left, margin_);
            while (lanes != 0) {
                Hit hit;
                if (!meets(ray, pack.first + take_lane(lanes), reach, hit)) continue;
                if (visit(hit)) return;
                left = ray.units_to(reach);
            }
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        Eigen::Array4f enter;
        unsigned lanes = ray.enters(node, left, enter);
        assert(top + 4 <= stack.size());
        const std::size_t bottom = top;
        while (lanes != 0) {
            const unsigned lane = take_lane(lanes);
            const float here = enter[lane];
            std::size_t place = top++;
            if constexpr (kNearestFirst) {
                // The nearest child comes last onto the stack, so it is the next one.
                for (; place > bottom && stack[place - 1].enter < here; --place) {
                    stack[place] = stack[place - 1];
                }
            }
            stack[place] = {node.child[lane], here};
        }
    }
}

bool TriangleBvh::segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    bool blocked = false;
    double reach = 1.0;  // the direction is not normalised, so the segment ends at t = 1
    traverse<false>(Ray(a, b - a, *this), reach, [&](const Hit&) { return blocked = true; });
    return blocked;
}

std::optional<TriangleBvh::Hit> TriangleBvh::first_hit(const Eigen::Vector3d& origin,
                                                       const Eigen::Vector3d& direction,
                                                       double max_distance_m) const {
    std::optional<Hit> nearest;
    double reach = max_distance_m;
    traverse<true>(Ray(origin, direction, *this), reach, [&](const Hit& hit) {
        const bool nearer = !nearest || hit.distance_m < nearest->distance_m ||
                            (hit.distance_m == nearest->distance_m && hit.face < nearest->face);
        if (nearer) {
            nearest = hit;
            reach = hit.distance_m;
        }
        return false;
    });
    return nearest;
}

std::vector<TriangleBvh::Hit> TriangleBvh::all_hits(const Eigen::Vector3d& origin,
                                                    const Eigen::Vector3d& direction,
                                                    double max_distance_m) const {
    std::vector<Hit> hits;
    double reach = max_distance_m;
    traverse<false>(Ray(origin, direction, *this), reach, [&](const Hit& hit) {
        hits.push_back(hit);
        return false;
    });
    std::ranges::sort(hits, [](const Hit& a, const Hit& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.face < b.face;
    });
    const auto same = [&](const Hit& a, const Hit& b) {
        return a.from_outside == b.from_outside &&
               b.distance_m - a.distance_m <= 2.0 * tolerance_m_;
    };
    hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
    return hits;
}

bool TriangleBvh::contains(const Eigen::Vector3d& point) const {
    if (!bounds_.contains(point)) return false;
    // Directions without zeros or equal components, so that they are parallel to no edge of a
    // boxy object.
    static const std::array<Eigen::Vector3d, 3> kDirections = {
        Eigen::Vector3d(0.6131, 0.7223, 0.3201).normalized(),
        Eigen::Vector3d(-0.5417, 0.2939, 0.7875).normalized(),
        Eigen::Vector3d(0.2113, -0.8341, -0.5095).normalized()};
    int inside = 0, outside = 0;
    for (const Eigen::Vector3d& direction : kDirections) {
        const auto hit = first_hit(point, direction, diagonal_m_);
        ++(hit && !hit->from_outside ? inside : outside);
        if (inside == 2 || outside == 2) break;
    }
    return inside == 2;
}

}  // namespace graspd
