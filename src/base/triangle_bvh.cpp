#include "graspd/base/triangle_bvh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "graspd/base/heap_bytes.hpp"
#include "graspd/base/lanes.hpp"
#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

// Single precision rounds by 6e-8; coordinates stay below 1, so three roundings fit in here.
constexpr float kPad = 5e-7F;
constexpr float kSlack = 1.0F + 1e-6F;
constexpr float kRounding = 2e-6F;  // of a triangle's products, over its longest edge's powers

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
    std::array<Eigen::Array4f, 3> start, along, inverse;  ///< [units] from there; of unit length
    std::array<std::size_t, 3> near_side{};  ///< of a box along each axis: 0 low, 1 high

    Ray(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const TriangleBvh& bvh)
        : origin(from), direction(to) {
        for (auto* each : {&start, &along, &inverse}) each->fill(Eigen::Array4f::Zero());
        const double length_m = to.norm();
        if (bvh.packs_.empty() || !(length_m > 0.0)) return;
        units_per_t = length_m * bvh.units_per_m_;
        // Directions as good as zero count as a huge finite inverse: infinity times 0 is no number.
        constexpr double kLeast = 1e-30;
        const Eigen::Vector3d unit = direction * (1.0 / length_m);
        Eigen::Vector3d inverted;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            inverted[axis] = std::abs(unit[axis]) > kLeast ? 1.0 / unit[axis] : 1.0 / kLeast;
            const auto a = static_cast<std::size_t>(axis);
            inverse[a].setConstant(static_cast<float>(inverted[axis]));
            along[a].setConstant(static_cast<float>(unit[axis]));
            near_side[a] = inverted[axis] < 0.0;
        }
        meets_bounds = bvh.bounds_.contains(from) || enter_bounds(inverted, bvh);
        if (!meets_bounds) return;
        const Eigen::Vector3d entry = (from - bvh.middle_) * bvh.units_per_m_ + skipped * unit;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            start[axis].setConstant(static_cast<float>(entry[static_cast<Eigen::Index>(axis)]));
        }
    }

    /// From outside: skips what lies before the bounds. @return whether the ray comes into them
    bool enter_bounds(const Eigen::Vector3d& inverted, const TriangleBvh& bvh) {
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

TriangleBvh::TriangleBvh(const TriangleMesh& mesh, double tolerance_m)
    : tolerance_m_(tolerance_m), vertices_(mesh.vertices) {
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t vertex : face) bounds_.extend(mesh.vertices[vertex]);
    }
    if (bounds_.isEmpty()) return;
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(tolerance_m);
    bounds_ = Eigen::AlignedBox3d(bounds_.min() - pad, bounds_.max() + pad);
    diagonal_m_ = bounds_.diagonal().norm();
    units_per_m_ = 1.0 / diagonal_m_;
    middle_ = bounds_.center();
    const float pad_units = static_cast<float>(tolerance_m / diagonal_m_) + kPad;
    margin_ = static_cast<float>(tolerance_m / diagonal_m_) + kRounding;
    stop_point();
    std::vector<Eigen::Array4f> units(mesh.vertices.size(), Eigen::Array4f::Zero());
    for (std::size_t v = 0; v < units.size(); ++v) {
        units[v].head<3>() = ((mesh.vertices[v] - middle_) * units_per_m_).cast<float>();
    }
    std::vector<Box4f> boxes;
    boxes.reserve(mesh.faces.size());
    std::vector<std::uint32_t> solid;  // faces with an area
    solid.reserve(mesh.faces.size());
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        stop_point(face);
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
        stop_point(number_.size());
        number_.push_back(solid[place]);
        faces_.push_back(mesh.faces[solid[place]]);
    }
    packs_.reserve(tree_.nodes.size() * 3 + 1);
    if (BoxTree::is_leaf(tree_.root)) add_pack(tree_.root);
    std::size_t step = 0;
    for (BoxTree::Node& node : tree_.nodes) {
        stop_point(step++);
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
        pack.origin[axis] = pack.edge1[axis] = pack.edge2[axis] = pack.normal[axis] =
            Eigen::Array4f::Zero();
    }
    pack.longest = Eigen::Array4f::Constant(-1.0F);
    for (std::uint32_t k = 0; k < pack.count; ++k) {
        const Triangle& t = faces_[pack.first + k];
        const Eigen::Vector3d& corner = vertices_[t[0]];
        const Eigen::Vector3d origin = (corner - middle_) * units_per_m_;
        const Eigen::Vector3d edge1 = (vertices_[t[1]] - corner) * units_per_m_;
        const Eigen::Vector3d edge2 = (vertices_[t[2]] - corner) * units_per_m_;
        const Eigen::Vector3d normal = edge2.cross(edge1);
        const auto lane = static_cast<Eigen::Index>(k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            pack.origin[axis][lane] = static_cast<float>(origin[a]);
            pack.edge1[axis][lane] = static_cast<float>(edge1[a]);
            pack.edge2[axis][lane] = static_cast<float>(edge2[a]);
            pack.normal[axis][lane] = static_cast<float>(normal[a]);
        }
        pack.longest[lane] = static_cast<float>(longest_edge(edge1, edge2));
    }
    leaf = BoxTree::kLeafBit | static_cast<std::uint32_t>(packs_.size()) << 3 | pack.count;
    packs_.push_back(pack);
}

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
    const Eigen::Vector3d s = ray.origin - corner;
    const Eigen::Vector3d q = s.cross(edge1);
    const double u = s.dot(p) * scale;
    const double v = ray.direction.dot(q) * scale;
    const double t = edge2.dot(q) * scale;
    if (!(t >= 0.0 && t <= reach)) return false;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) {
        const double tolerance = tolerance_m_ / least_height(edge1, edge2);
        if (!(u >= -tolerance && v >= -tolerance && u + v <= 1.0 + tolerance)) return false;
        if (u > 1.0 + tolerance) return false;
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

/// Whether one of a pack's triangles meets the ray before t = 1, `reach` in units.
inline bool TriangleBvh::pack_blocks(const Ray& ray, const Pack& pack, float reach) const {
    unsigned lanes = near_lanes(ray, pack, reach, margin_);
    while (lanes != 0) {
        Hit hit;
        if (meets(ray, pack.first + take_lane(lanes), 1.0, hit)) return true;
    }
    return false;
}

bool TriangleBvh::segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  Blocker& blocker) const {
    const Ray ray(a, b - a, *this);  // not normalised, so the segment ends at t = 1
    if (!ray.meets_bounds) return false;
    const float reach = ray.units_to(1.0);
    const std::uint32_t likely = blocker.pack;
    if (likely < packs_.size() && pack_blocks(ray, packs_[likely], reach)) return true;
    std::array<std::uint32_t, BoxTree::kStackDepth> stack;
    std::size_t top = 0;
    stack[top++] = tree_.root;
    while (top > 0) {
        const std::uint32_t child = stack[--top];
        if (BoxTree::is_leaf(child)) {
            const std::uint32_t place = BoxTree::leaf_first(child);
            if (!pack_blocks(ray, packs_[place], reach)) continue;
            blocker.pack = place;
            return true;
        }
        const BoxTree::Node& node = tree_.nodes[child];
        Eigen::Array4f enter;
        unsigned lanes = ray.enters(node, reach, enter);
        assert(top + 4 <= stack.size());
        while (lanes != 0) stack[top++] = node.child[take_lane(lanes)];
    }
    return false;
}

bool TriangleBvh::segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    Blocker unknown;
    return segment_blocked(a, b, unknown);
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

std::uint64_t TriangleBvh::bytes() const {
    return sizeof *this + heap_bytes(tree_.nodes) + heap_bytes(tree_.order) +
           heap_bytes(vertices_) + heap_bytes(faces_) + heap_bytes(number_) + heap_bytes(packs_);
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
