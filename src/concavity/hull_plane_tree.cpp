#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "graspd/concavity/outer_hull.hpp"

namespace graspd {
namespace {

// Boxes are padded by what single precision may round away (coordinates stay below 1), so that a
// distance to a box never exceeds the true one.
constexpr float kPad = 1e-6F;

Eigen::Array4f to_units(const Eigen::Vector3d& point, const Eigen::Vector3d& middle,
                        double diagonal_m) {
    Eigen::Array4f unit = Eigen::Array4f::Zero();
    unit.head<3>() = ((point - middle) / diagonal_m).cast<float>();
    return unit;
}

/// Squared distances from a point to the children's boxes; infinite for one that is not there.
Eigen::Array4f squared_distances(const BoxTree::Node& node, const Eigen::Array4f& point) {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float at = point[static_cast<Eigen::Index>(axis)];
        const Eigen::Array4f outside =
            (node.bound[axis][0] - at).max(at - node.bound[axis][1]).max(0.0F);
        sum += outside * outside;
    }
    return sum;
}

}  // namespace

HullPlaneTree::HullPlaneTree(const OuterHull& hull) : facets_(hull.facets) {
    assert(!facets_.empty());
    Eigen::AlignedBox3d all;
    for (const HullFacet& facet : facets_) all.extend(facet.box);
    middle_ = all.center();
    diagonal_m_ = all.diagonal().norm();
    std::vector<Box4f> boxes;
    boxes.reserve(facets_.size());
    for (const HullFacet& facet : facets_) {
        boxes.push_back({to_units(facet.box.min(), middle_, diagonal_m_) - kPad,
                         to_units(facet.box.max(), middle_, diagonal_m_) + kPad});
    }
    tree_ = build_box_tree(boxes);
}

HullPlaneTree::Nearest HullPlaneTree::nearest(const Eigen::Vector3d& point) const {
    struct Waiting {
        std::uint32_t child;
        float squared;
    };
    const Eigen::Array4f unit = to_units(point, middle_, diagonal_m_);
    Nearest best{std::numeric_limits<double>::infinity(), 0};
    float least = std::numeric_limits<float>::infinity();  // squared best distance in units
    std::array<Waiting, BoxTree::kStackDepth> stack;
    std::size_t top = 0;
    stack[top++] = {tree_.root, 0.0F};
    while (top > 0) {
        const Waiting item = stack[--top];
        // The nearest plane's foot lies on its facet, hence in the facet's box.
        if (item.squared > least) continue;
        if (BoxTree::is_leaf(item.child)) {
            const std::uint32_t first = BoxTree::leaf_first(item.child);
            for (std::uint32_t i = first; i < first + BoxTree::leaf_count(item.child); ++i) {
                const std::uint32_t index = tree_.order[i];
                const HullFacet& facet = facets_[index];
                const double distance = std::max(0.0, facet.offset_m - facet.normal.dot(point));
                if (distance > best.distance_m) continue;
                if (distance == best.distance_m && index > best.facet) continue;
                best = {distance, index};
                const double units = distance / diagonal_m_;
                least = static_cast<float>(units * units * (1.0 + 1e-6));
            }
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        const Eigen::Array4f squared = squared_distances(node, unit);
        assert(top + 4 <= stack.size());
        const std::size_t bottom = top;
        for (std::size_t k = 0; k < 4; ++k) {
            const float here = squared[static_cast<Eigen::Index>(k)];
            if (!(here <= least) || here == std::numeric_limits<float>::infinity()) continue;
            std::size_t place = top++;  // the nearest child comes last, so it is the next one
            for (; place > bottom && stack[place - 1].squared < here; --place) {
                stack[place] = stack[place - 1];
            }
            stack[place] = {node.child[k], here};
        }
    }
    return best;
}

std::uint32_t HullPlaneTree::exit(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    for (std::uint32_t index = 0; index < facets_.size(); ++index) {
        const double slope = facets_[index].normal.dot(direction);
        if (!(slope > 0.0)) continue;
        const double distance_m =
            (facets_[index].offset_m - facets_[index].normal.dot(origin)) / slope;
        if (distance_m >= nearest_m) continue;
        nearest_m = distance_m;
        best = index;
    }
    return best;
}

}  // namespace graspd
