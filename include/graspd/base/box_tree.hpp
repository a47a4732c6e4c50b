#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace graspd {

/// A box in single precision; the fourth lane is idle. Without points low is above high.
struct Box4f {
    Eigen::Array4f low = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Array4f high = Eigen::Array4f::Constant(-std::numeric_limits<float>::infinity());

    void extend(const Box4f& other) {
        low = low.min(other.low);
        high = high.max(other.high);
    }
};

/// A tree of boxes, up to four children side by side, over things that the owner numbers.
struct BoxTree {
    struct Node {
        /// [axis][0: low, 1: high], one lane a child. Nothing is inside a child that is not there,
        /// whose low is +infinity and whose high is -infinity.
        std::array<std::array<Eigen::Array4f, 2>, 3> bound;
        std::array<std::uint32_t, 4> child{};  ///< a node's index, or a leaf
    };
    static constexpr std::uint32_t kLeafBit = 1u << 31;
    static constexpr std::uint32_t kLeafSize = 4;
    static constexpr int kStackDepth = 192;  ///< of a walk that keeps the siblings of its way

    static bool is_leaf(std::uint32_t child) { return (child & kLeafBit) != 0; }
    /// Place of the leaf's first thing in `order`, and how many it holds.
    static std::uint32_t leaf_first(std::uint32_t child) { return (child & ~kLeafBit) >> 3; }
    static std::uint32_t leaf_count(std::uint32_t child) { return child & 7u; }

    std::uint32_t root = kLeafBit;  ///< an empty leaf
    std::vector<Node> nodes;
    std::vector<std::uint32_t> order;  ///< the things' numbers, in the order of the leaves
};

/// Near the root splits by binned surface area (Wald 2007) over clusters of neighbours on a Morton
/// curve, below along the curve (Lauterbach et al. 2009), four ways at a time. Against surface area
/// all the way down it builds several times as fast for some percent more boxes per ray
/// (docs/concavity.md).
/// @param boxes  at most 2^28; box i is that of thing i
/// Complexity O(N log N). The result depends on the boxes and their order alone.
BoxTree build_box_tree(const std::vector<Box4f>& boxes);

}  // namespace graspd
