#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "graspd/base/lanes.hpp"
#include "graspd/concavity/outer_hull.hpp"

namespace graspd::concavity_detail {

// What every walk down a tree of hull planes needs.

// Boxes and planes are padded by what single precision may round away (coordinates stay below 1),
// so that nothing nearer than the best found is ever skipped.
inline constexpr float kPlanePad = 1e-6F;
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// Squared distances from a point to the children's boxes; infinite for one that is not there.
inline Eigen::Array4f squared_distances(const BoxTree::Node& node, const Eigen::Array4f& point) {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float at = point[static_cast<Eigen::Index>(axis)];
        const Eigen::Array4f outside =
            (node.bound[axis][0] - at).max(at - node.bound[axis][1]).max(0.0F);
        sum += outside * outside;
    }
    return sum;
}

struct WaitingPlanes {
    std::uint32_t child;
    float distance;  ///< squared to the child's box, or along a ray
};

/// A walk's open ends, the nearest of each node's children on top.
class WaitingList {
public:
    explicit WaitingList(std::uint32_t root) { stack_[top_++] = {root, 0.0F}; }

    bool empty() const { return top_ == 0; }
    WaitingPlanes take() { return stack_[--top_]; }

    void push_children(const BoxTree::Node& node, unsigned lanes, const Eigen::Array4f& distances) {
        assert(top_ + 4 <= stack_.size());
        const std::size_t bottom = top_;
        while (lanes != 0) {
            const unsigned lane = take_lane(lanes);
            const float here = distances[lane];
            std::size_t place = top_++;
            for (; place > bottom && stack_[place - 1].distance < here; --place) {
                stack_[place] = stack_[place - 1];
            }
            stack_[place] = {node.child[lane], here};
        }
    }

private:
    std::array<WaitingPlanes, BoxTree::kStackDepth> stack_;
    std::size_t top_ = 0;
};

}  // namespace graspd::concavity_detail
