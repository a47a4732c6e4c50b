#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "graspd/base/box_triangle.hpp"
#include "graspd/base/lanes.hpp"
#include "graspd/base/triangle_bvh.hpp"

// What the tree answers about boxes; rays are in triangle_bvh_rays.cpp.

namespace graspd {
namespace {

// Single precision rounds by 6e-8; a coordinate has come through some ten roundings at the most.
constexpr float kBoxPad = 2e-6F;

/// Four numbers by each axis.
using Lanes3 = std::array<Eigen::Array4f, 3>;

}  // namespace

/// A box of any direction in the tree's own units, grown by the distance that counts as near.
struct TriangleBvh::Vicinity {
    Eigen::Matrix3f axes, spread;
    Eigen::Vector3f center, half, reach;  ///< half along its own axes, reach along the world's
    float pad = kBoxPad;                  ///< of a coordinate's rounding

    Vicinity(const OrientedBox& box, double within_m, const TriangleBvh& bvh) {
        const Eigen::Vector3d place =
            (box.pose.translation() - bvh.bounds_.center()) / bvh.diagonal_m_;
        const Eigen::Vector3d size = box.half_extent / bvh.diagonal_m_;
        // Rounding in single precision must not lose a face that touches.
        pad = kBoxPad * static_cast<float>(1.0 + place.norm() + size.norm());
        const double grown = within_m / bvh.diagonal_m_ + static_cast<double>(pad);
        axes = box.pose.linear().cast<float>();
        spread = axes.cwiseAbs();
        center = place.cast<float>();
        half = (size.array() + grown).matrix().cast<float>();
        reach = (box.pose.linear().cwiseAbs() * size).cast<float>();
        reach.array() += static_cast<float>(grown);
    }

    /// Per child: how far the boxes lie apart along the axis on which they do so most; an absent
    /// child gives no number.
    Eigen::Array4f gaps(const BoxTree::Node& node) const {
        Lanes3 offset, size;
        Eigen::Array4f gap = Eigen::Array4f::Constant(-std::numeric_limits<float>::infinity());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            offset[axis] = 0.5F * (node.bound[axis][0] + node.bound[axis][1]) - center[a];
            size[axis] = 0.5F * (node.bound[axis][1] - node.bound[axis][0]);
            gap = gap.max(offset[axis].abs() - size[axis] - reach[a]);
        }
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Eigen::Array4f along =
                offset[0] * axes(0, k) + offset[1] * axes(1, k) + offset[2] * axes(2, k);
            const Eigen::Array4f wide =
                size[0] * spread(0, k) + size[1] * spread(1, k) + size[2] * spread(2, k);
            gap = gap.max(along.abs() - wide - half[k]);
        }
        return gap;
    }

    /// Vectors of the world in the box's axes.
    Lanes3 turned(const Lanes3& v) const {
        Lanes3 out;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = static_cast<Eigen::Index>(k);
            out[k] = v[0] * axes(0, a) + v[1] * axes(1, a) + v[2] * axes(2, a);
        }
        return out;
    }

    /// By the axis that is upright on an edge and on the box's k-th: the gap between the edge with
    /// the opposite corner and the box.
    Eigen::Array4f gap_across(std::size_t k, const Lanes3& edge, const Lanes3& corner,
                              const Lanes3& opposite) const {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const auto place = [&](const Lanes3& p) { return edge[u] * p[v] - edge[v] * p[u]; };
        const Eigen::Array4f wide = edge[u].abs() * half[static_cast<Eigen::Index>(v)] +
                                    edge[v].abs() * half[static_cast<Eigen::Index>(u)];
        const Eigen::Array4f p = place(corner), q = place(opposite);
        return p.min(q).max(-p.max(q)) - wide;
    }
};

/// Which triangles of a pack no axis parts from the box; some that touch nothing pass.
unsigned TriangleBvh::near_lanes(const Vicinity& vicinity, const Pack& pack) {
    Lanes3 from = pack.origin;
    for (std::size_t k = 0; k < 3; ++k) from[k] -= vicinity.center[static_cast<Eigen::Index>(k)];
    const Lanes3 a = vicinity.turned(from);
    const Lanes3 edge1 = vicinity.turned(pack.edge1), edge2 = vicinity.turned(pack.edge2);
    Lanes3 b, c, edge3;
    Eigen::Array4f gap = -pack.longest;  // parts what is not there
    for (std::size_t k = 0; k < 3; ++k) {
        b[k] = a[k] + edge1[k];
        c[k] = a[k] + edge2[k];
        edge3[k] = edge2[k] - edge1[k];
        gap = gap.max(a[k].min(b[k]).min(c[k]).max(-a[k].max(b[k]).max(c[k])) -
                      vicinity.half[static_cast<Eigen::Index>(k)]);
    }
    const Eigen::Array4f margin = vicinity.pad * pack.longest;
    Eigen::Array4f height = Eigen::Array4f::Zero(), wide = margin * pack.longest;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const Eigen::Array4f normal = edge1[u] * edge2[v] - edge1[v] * edge2[u];
        height += normal * a[k];
        wide += normal.abs() * vicinity.half[static_cast<Eigen::Index>(k)];
        gap = gap.max(vicinity.gap_across(k, edge1, a, c) - margin);
        gap = gap.max(vicinity.gap_across(k, edge2, a, b) - margin);
        gap = gap.max(vicinity.gap_across(k, edge3, b, a) - margin);
    }
    gap = gap.max(height.abs() - wide);
    return lanes_not_negative(-gap);
}

/// Packs whose tree boxes no axis of either box parts from the vicinity, those first that reach
/// into it deepest. @return whether `visit` ended it by returning true
template <class Visit>
bool TriangleBvh::visit_near(const Vicinity& vicinity, Visit&& visit) const {
    std::array<std::uint32_t, BoxTree::kStackDepth> stack;
    std::array<float, BoxTree::kStackDepth> depth;  // below zero
    std::size_t top = 0;
    stack[top++] = tree_.root;
    while (top > 0) {
        const std::uint32_t child = stack[--top];
        if (BoxTree::is_leaf(child)) {
            if (visit(packs_[BoxTree::leaf_first(child)])) return true;
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[child];
        const Eigen::Array4f gap = vicinity.gaps(node);
        // An absent child's gap is no number or infinite, and its sign says nothing.
        unsigned lanes =
            lanes_not_negative(-gap) & lanes_not_negative(node.bound[0][1] - node.bound[0][0]);
        assert(top + 4 <= stack.size());
        const std::size_t bottom = top;
        while (lanes != 0) {
            const unsigned lane = take_lane(lanes);
            std::size_t place = top++;
            for (; place > bottom && depth[place - 1] < gap[lane]; --place) {
                stack[place] = stack[place - 1];
                depth[place] = depth[place - 1];
            }
            stack[place] = node.child[lane];
            depth[place] = gap[lane];
        }
    }
    return false;
}

std::vector<std::uint32_t> TriangleBvh::faces_near(const OrientedBox& box, double within_m) const {
    std::vector<std::uint32_t> faces;
    if (packs_.empty()) return faces;
    visit_near(Vicinity(box, within_m, *this), [&](const Pack& pack) {
        faces.insert(faces.end(), number_.begin() + pack.first,
                     number_.begin() + pack.first + pack.count);
        return false;
    });
    std::ranges::sort(faces);
    return faces;
}

bool TriangleBvh::meets_box(const OrientedBox& box, const Eigen::Vector3d& way) const {
    if (packs_.empty()) return false;
    const Eigen::Matrix3d to_box = box.pose.linear().transpose();
    const Eigen::Vector3d half_way = 0.5 * (to_box * way);
    OrientedBox around = box;  // all of the way
    around.pose.translation() += 0.5 * way;
    around.half_extent += half_way.cwiseAbs();
    const Vicinity vicinity(around, 0.0, *this);
    return visit_near(vicinity, [&](const Pack& pack) {
        unsigned lanes = near_lanes(vicinity, pack);
        while (lanes != 0) {
            const Triangle& face = faces_[pack.first + take_lane(lanes)];
            std::array<Eigen::Vector3d, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = to_box * (vertices_[face[i]] - around.pose.translation());
            }
            if (box_meets_triangle(box.half_extent, half_way, corners)) return true;
        }
        return false;
    });
}

bool TriangleBvh::surrounds(const OrientedBox& box) const {
    const Eigen::Vector3d& center = box.pose.translation();
    const Eigen::Vector3d reach = box.pose.linear().cwiseAbs() * box.half_extent;
    // A box of which some part lies outside the bounds lies inside of nothing; no ray is needed.
    return bounds_.contains(center - reach) && bounds_.contains(center + reach) && contains(center);
}

}  // namespace graspd
