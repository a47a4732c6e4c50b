#include <algorithm>
#include <cassert>
#include <cmath>

#include "triangle_bvh_ray.hpp"

// What the tree answers about rays, segments and points; boxes are in triangle_bvh_box.cpp.

namespace graspd {
namespace {

/// Twice the area over the longest edge.
double least_height(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    return edge1.cross(edge2).norm() / longest_edge(edge1, edge2);
}

/// Squared distance from a point to a segment that starts at the origin.
double squared_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& segment) {
    const double share = std::clamp(point.dot(segment) / segment.squaredNorm(), 0.0, 1.0);
    return (point - share * segment).squaredNorm();
}

}  // namespace

bool TriangleBvh::Hit::keep_if_nearer(std::optional<Hit>& nearest) const {
    if (nearest && (distance_m > nearest->distance_m ||
                    (distance_m == nearest->distance_m && face >= nearest->face))) {
        return false;
    }
    nearest = *this;
    return true;
}

/// Moller-Trumbore; a hit beside the triangle counts within the tolerance of its edges.
bool TriangleBvh::meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                        std::uint32_t place, double reach, Hit& hit) const {
    const Triangle& face = faces_[place];
    const Eigen::Vector3d& corner = vertices_[face[0]];
    const Eigen::Vector3d edge1 = vertices_[face[1]] - corner;
    const Eigen::Vector3d edge2 = vertices_[face[2]] - corner;
    const Eigen::Vector3d p = direction.cross(edge2);
    const double determinant = edge1.dot(p);
    if (determinant == 0.0) return false;
    const double scale = 1.0 / determinant;
    const Eigen::Vector3d s = origin - corner;
    const Eigen::Vector3d q = s.cross(edge1);
    const double u = s.dot(p) * scale;
    const double v = direction.dot(q) * scale;
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
                const std::uint32_t place = pack.first + take_lane(lanes);
                if (!meets(ray.origin, ray.direction, place, reach, hit)) continue;
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
        const std::uint32_t place = pack.first + take_lane(lanes);
        if (meets(ray.origin, ray.direction, place, 1.0, hit)) return true;
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
        if (hit.keep_if_nearer(nearest)) reach = hit.distance_m;
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
