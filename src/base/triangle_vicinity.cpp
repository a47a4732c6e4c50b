// The part of TriangleBvh that finds the faces near a box.

#include <algorithm>
#include <cassert>
#include <limits>

#include "graspd/base/triangle_bvh.hpp"

namespace graspd {
namespace {

// Single precision rounds by 6e-8; coordinates stay below 1, so a good dozen roundings fit in here.
constexpr double kPad = 2e-6;
constexpr float kNever = std::numeric_limits<float>::infinity();

}  // namespace

/// A box of any direction in the tree's own units, grown by the distance that counts as near.
struct TriangleBvh::Vicinity {
    Eigen::Matrix3f axes, spread;
    Eigen::Vector3f center, half, reach;  ///< half along its own axes, reach along the world's

    Vicinity(const OrientedBox& box, double within_m, const TriangleBvh& bvh) {
        // Rounding in single precision must not lose a face that touches.
        const double pad = within_m / bvh.diagonal_m_ + kPad;
        axes = box.pose.linear().cast<float>();
        spread = axes.cwiseAbs();
        center = ((box.pose.translation() - bvh.middle_) * bvh.units_per_m_).cast<float>();
        half = ((box.half_extent / bvh.diagonal_m_).array() + pad).matrix().cast<float>();
        reach = (box.pose.linear().cwiseAbs() * (box.half_extent / bvh.diagonal_m_)).cast<float>();
        reach.array() += static_cast<float>(pad);
    }

    /// Per child: how far the boxes lie apart along the axis on which they do so most; an absent
    /// child gives no number.
    Eigen::Array4f gaps(const BoxTree::Node& node) const {
        std::array<Eigen::Array4f, 3> offset, size;
        Eigen::Array4f gap = Eigen::Array4f::Constant(-kNever);
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
};

std::vector<std::uint32_t> TriangleBvh::faces_near(const OrientedBox& box, double within_m) const {
    std::vector<std::uint32_t> faces;
    if (packs_.empty()) return faces;
    const Vicinity vicinity(box, within_m, *this);
    std::array<std::uint32_t, BoxTree::kStackDepth> stack;
    std::size_t top = 0;
    stack[top++] = tree_.root;
    while (top > 0) {
        const std::uint32_t child = stack[--top];
        if (BoxTree::is_leaf(child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(child)];
            faces.insert(faces.end(), number_.begin() + pack.first,
                         number_.begin() + pack.first + pack.count);
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[child];
        const Eigen::Array4f gap = vicinity.gaps(node);
        assert(top + 4 <= stack.size());
        for (std::size_t k = 0; k < 4; ++k) {
            const auto lane = static_cast<Eigen::Index>(k);
            const bool is_there = node.bound[0][0][lane] <= node.bound[0][1][lane];
            if (is_there && gap[lane] <= 0.0F) stack[top++] = node.child[k];
        }
    }
    std::ranges::sort(faces);
    return faces;
}

}  // namespace graspd
