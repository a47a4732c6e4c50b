#include "graspd/base/triangle_bvh.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr int kBins = 12;
constexpr int kSahDepth = 64;     // below it the tree is halved by count: 32 more levels at most
constexpr int kStackDepth = 128;  // > kSahDepth + 32 + 1

double half_area(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return 0.0;
    const Eigen::Vector3d s = box.sizes();
    return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

/// Twice the area over the longest edge; zero for a degenerate triangle.
double least_height(const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2) {
    const double longest = std::max({edge1.norm(), edge2.norm(), (edge2 - edge1).norm()});
    return longest > 0.0 ? edge1.cross(edge2).norm() / longest : 0.0;
}

}  // namespace

struct TriangleBvh::BuildItem {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d center;
    Corner corner;
};

struct TriangleBvh::Ray {
    Eigen::Vector3d origin, direction, inverse;

    Ray(const Eigen::Vector3d& from, const Eigen::Vector3d& along)
        : origin(from), direction(along) {
        for (int axis = 0; axis < 3; ++axis) {
            // A huge finite value instead of infinity keeps 0 * inverse from becoming NaN.
            inverse[axis] = along[axis] != 0.0 ? 1.0 / along[axis] : 1e300;
        }
    }

    bool meets(const Eigen::AlignedBox3d& box, double reach) const {
        const Eigen::Array3d t0 = (box.min() - origin).array() * inverse.array();
        const Eigen::Array3d t1 = (box.max() - origin).array() * inverse.array();
        const double enter = t0.min(t1).maxCoeff();
        const double leave = t0.max(t1).minCoeff();
        return std::max(enter, 0.0) <= std::min(leave, reach);
    }

    /// Moller-Trumbore with a tolerance on the barycentric coordinates.
    bool meets(const Corner& c, double reach, double& t, bool& from_outside) const {
        const Eigen::Vector3d p = direction.cross(c.edge2);
        const double determinant = c.edge1.dot(p);
        if (determinant == 0.0) return false;
        const double scale = 1.0 / determinant;
        const Eigen::Vector3d s = origin - c.origin;
        const double u = s.dot(p) * scale;
        if (!(u >= -c.tolerance && u <= 1.0 + c.tolerance)) return false;
        const Eigen::Vector3d q = s.cross(c.edge1);
        const double v = direction.dot(q) * scale;
        if (!(v >= -c.tolerance && u + v <= 1.0 + c.tolerance)) return false;
        t = c.edge2.dot(q) * scale;
        from_outside = determinant > 0.0;
        return t >= 0.0 && t <= reach;
    }
};

TriangleBvh::TriangleBvh(const TriangleMesh& mesh, double tolerance_m) : tolerance_m_(tolerance_m) {
    std::vector<BuildItem> items;
    items.reserve(mesh.faces.size());
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(tolerance_m);
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        const Triangle& t = mesh.faces[face];
        const Eigen::Vector3d& a = mesh.vertices[t[0]];
        const Eigen::Vector3d& b = mesh.vertices[t[1]];
        const Eigen::Vector3d& c = mesh.vertices[t[2]];
        const double height = least_height(b - a, c - a);
        if (!(height > 0.0)) continue;
        BuildItem item;
        item.box = Eigen::AlignedBox3d(a).extend(b).extend(c);
        item.center = item.box.center();
        item.box = Eigen::AlignedBox3d(item.box.min() - pad, item.box.max() + pad);
        item.corner = {a, b - a, c - a, tolerance_m / height, face};
        items.push_back(item);
    }
    if (items.empty()) return;
    nodes_.reserve(items.size());
    build(items, 0, static_cast<std::uint32_t>(items.size()), 0);
    corners_.reserve(items.size());
    for (const BuildItem& item : items) corners_.push_back(item.corner);
    bounds_ = nodes_.front().box;
}

std::uint32_t TriangleBvh::split(std::vector<BuildItem>& items, std::uint32_t first,
                                 std::uint32_t last, int axis, double low, double width) {
    const auto bin_of = [&](const BuildItem& item) {
        const int bin = static_cast<int>((item.center[axis] - low) / width * kBins);
        return std::clamp(bin, 0, kBins - 1);
    };
    std::array<Eigen::AlignedBox3d, kBins> boxes;
    std::array<std::uint32_t, kBins> counts{};
    for (std::uint32_t i = first; i < last; ++i) {
        const int bin = bin_of(items[i]);
        boxes[bin].extend(items[i].box);
        ++counts[bin];
    }
    std::array<double, kBins> right_cost{};
    Eigen::AlignedBox3d swept;
    std::uint32_t swept_count = 0;
    for (int bin = kBins - 1; bin > 0; --bin) {
        swept.extend(boxes[bin]);
        swept_count += counts[bin];
        right_cost[bin] = half_area(swept) * swept_count;
    }
    swept.setEmpty();
    swept_count = 0;
    int best_split = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    for (int bin = 1; bin < kBins; ++bin) {
        swept.extend(boxes[bin - 1]);
        swept_count += counts[bin - 1];
        const double cost = half_area(swept) * swept_count + right_cost[bin];
        if (swept_count > 0 && swept_count < last - first && cost < best_cost) {
            best_cost = cost;
            best_split = bin;
        }
    }
    const auto middle =
        std::stable_partition(items.begin() + first, items.begin() + last,
                              [&](const BuildItem& item) { return bin_of(item) < best_split; });
    return static_cast<std::uint32_t>(middle - items.begin());
}

std::uint32_t TriangleBvh::build(std::vector<BuildItem>& items, std::uint32_t first,
                                 std::uint32_t last, int depth) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Eigen::AlignedBox3d box, centers;
    for (std::uint32_t i = first; i < last; ++i) {
        box.extend(items[i].box);
        centers.extend(items[i].center);
    }
    nodes_[index].box = box;
    int axis = 0;
    const double width = centers.sizes().maxCoeff(&axis);
    if (last - first <= kLeafSize) {
        nodes_[index].first = first;
        nodes_[index].count = last - first;
        return index;
    }
    const bool by_cost = depth < kSahDepth && width > 0.0;
    const std::uint32_t middle = by_cost
                                     ? split(items, first, last, axis, centers.min()[axis], width)
                                     : first + (last - first) / 2;
    build(items, first, middle, depth + 1);
    const std::uint32_t right = build(items, middle, last, depth + 1);
    nodes_[index].first = right;
    return index;
}

template <class Visit>
void TriangleBvh::traverse(const Ray& ray, double& reach, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, kStackDepth> stack;
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const std::uint32_t index = stack[--top];
        const Node& node = nodes_[index];
        if (!ray.meets(node.box, reach)) continue;
        if (node.count == 0) {
            assert(top + 2 <= kStackDepth);
            stack[top++] = node.first;
            stack[top++] = index + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            double t = 0.0;
            bool from_outside = true;
            if (!ray.meets(corners_[i], reach, t, from_outside)) continue;
            if (visit(Hit{t, corners_[i].face, from_outside})) return;
        }
    }
}

bool TriangleBvh::segment_blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    bool blocked = false;
    double reach = 1.0;  // the direction is not normalised, so the segment ends at t = 1
    traverse(Ray(a, b - a), reach, [&](const Hit&) { return blocked = true; });
    return blocked;
}

std::optional<TriangleBvh::Hit> TriangleBvh::first_hit(const Eigen::Vector3d& origin,
                                                       const Eigen::Vector3d& direction,
                                                       double max_distance_m) const {
    std::optional<Hit> nearest;
    double reach = max_distance_m;
    traverse(Ray(origin, direction), reach, [&](const Hit& hit) {
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
    traverse(Ray(origin, direction), reach, [&](const Hit& hit) {
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

std::vector<std::uint32_t> TriangleBvh::faces_near(const OrientedBox& box, double within_m) const {
    std::vector<std::uint32_t> faces;
    if (nodes_.empty()) return faces;
    const Eigen::Matrix3d axes = box.pose.linear();
    const Eigen::Matrix3d spread = axes.cwiseAbs();
    const Eigen::Vector3d center = box.pose.translation();
    const Eigen::Vector3d reach = spread * box.half_extent;  // of the box along the world's axes
    const auto near = [&](const Eigen::AlignedBox3d& node) {
        const Eigen::Vector3d offset = node.center() - center;
        const Eigen::Vector3d half = 0.5 * node.sizes();
        const Eigen::Array3d gap_world = offset.array().abs() - half.array() - reach.array();
        if (gap_world.maxCoeff() > within_m) return false;
        const Eigen::Vector3d offset_box = axes.transpose() * offset;
        const Eigen::Vector3d half_box = spread.transpose() * half;
        return ((offset_box.array().abs() - half_box.array() - box.half_extent.array())
                    .maxCoeff()) <= within_m;
    };
    std::array<std::uint32_t, kStackDepth> stack;
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const std::uint32_t index = stack[--top];
        const Node& node = nodes_[index];
        if (!near(node.box)) continue;
        if (node.count == 0) {
            stack[top++] = node.first;
            stack[top++] = index + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Corner& c = corners_[i];
            Eigen::AlignedBox3d triangle(c.origin);
            triangle.extend(c.origin + c.edge1).extend(c.origin + c.edge2);
            if (near(triangle)) faces.push_back(c.face);
        }
    }
    std::ranges::sort(faces);
    return faces;
}

bool TriangleBvh::contains(const Eigen::Vector3d& point) const {
    if (nodes_.empty() || !bounds_.contains(point)) return false;
    // Directions without zeros or equal components, so that they are parallel to no edge of a
    // boxy object.
    static const std::array<Eigen::Vector3d, 3> kDirections = {
        Eigen::Vector3d(0.6131, 0.7223, 0.3201).normalized(),
        Eigen::Vector3d(-0.5417, 0.2939, 0.7875).normalized(),
        Eigen::Vector3d(0.2113, -0.8341, -0.5095).normalized()};
    const double reach = bounds_.diagonal().norm();
    int inside = 0;
    for (const Eigen::Vector3d& direction : kDirections) {
        const auto hit = first_hit(point, direction, reach);
        inside += hit && !hit->from_outside;
    }
    return inside >= 2;
}

}  // namespace graspd
