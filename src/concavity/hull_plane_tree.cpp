#include <algorithm>
#include <cassert>
#include <limits>

#include "graspd/base/stop.hpp"
#include "graspd/concavity/outer_hull.hpp"
#include "hull_plane_walk.hpp"

namespace graspd {

using namespace concavity_detail;

HullPlaneTree::HullPlaneTree(const OuterHull& hull) : facets_(hull.facets) {
    assert(!facets_.empty());
    Eigen::AlignedBox3d all;
    for (const HullFacet& facet : facets_) all.extend(facet.box);
    middle_ = all.center();
    diagonal_m_ = all.diagonal().norm();
    std::vector<Box4f> boxes;
    boxes.reserve(facets_.size());
    for (const HullFacet& facet : facets_) {
        boxes.push_back(
            {to_units(facet.box.min()) - kPlanePad, to_units(facet.box.max()) + kPlanePad});
    }
    tree_ = build_box_tree(boxes);
    if (BoxTree::is_leaf(tree_.root)) add_pack(tree_.root);
    std::size_t step = 0;
    for (BoxTree::Node& node : tree_.nodes) {
        stop_point(step++);
        for (std::uint32_t& child : node.child) {
            if (BoxTree::is_leaf(child)) add_pack(child);
        }
    }
    tree_.order.clear();
}

/// Lays a leaf's planes side by side and lets the leaf name the pack.
void HullPlaneTree::add_pack(std::uint32_t& leaf) {
    const std::uint32_t first = BoxTree::leaf_first(leaf), count = BoxTree::leaf_count(leaf);
    if (count == 0) return;
    Pack pack;
    for (auto* axes : {&pack.normal, &pack.center, &pack.extent}) {
        axes->fill(Eigen::Array4f::Zero());
    }
    pack.offset = Eigen::Array4f::Constant(kNever);
    for (std::uint32_t k = 0; k < count; ++k) {
        pack.facet[k] = tree_.order[first + k];
        const HullFacet& facet = facets_[pack.facet[k]];
        const auto lane = static_cast<Eigen::Index>(k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis);
            pack.normal[axis][lane] = static_cast<float>(facet.normal[a]);
            pack.center[axis][lane] =
                static_cast<float>((facet.box.center()[a] - middle_[a]) / diagonal_m_);
            pack.extent[axis][lane] = static_cast<float>(0.5 * facet.box.sizes()[a] / diagonal_m_);
        }
        pack.offset[lane] =
            static_cast<float>((facet.offset_m - facet.normal.dot(middle_)) / diagonal_m_);
    }
    leaf = BoxTree::kLeafBit | static_cast<std::uint32_t>(packs_.size()) << 3 | count;
    packs_.push_back(pack);
}

Eigen::Array4f HullPlaneTree::to_units(const Eigen::Vector3d& point) const {
    Eigen::Array4f unit = Eigen::Array4f::Zero();
    unit.head<3>() = ((point - middle_) / diagonal_m_).cast<float>();
    return unit;
}

HullPlaneTree::Nearest HullPlaneTree::nearest(const Eigen::Vector3d& point,
                                              std::uint32_t hint) const {
    const Eigen::Array4f unit = to_units(point);
    Nearest best{std::numeric_limits<double>::infinity(), hint};
    float least = kNever;  // best distance in units, padded
    const auto consider = [&](std::uint32_t index) {
        const HullFacet& facet = facets_[index];
        const double distance = std::max(0.0, facet.offset_m - facet.normal.dot(point));
        if (distance > best.distance_m) return;
        if (distance == best.distance_m && index > best.facet) return;
        best = {distance, index};
        least = static_cast<float>(distance / diagonal_m_) + kPlanePad;
    };
    consider(hint);
    WaitingList open(tree_.root);
    while (!open.empty()) {
        const WaitingPlanes item = open.take();
        // The nearest plane's foot lies on its facet, hence in the facet's box.
        if (item.distance > least * least) continue;
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            unsigned lanes = lanes_not_negative(least + kPlanePad - pack.distances(unit));
            while (lanes != 0) consider(pack.facet[take_lane(lanes)]);
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        const Eigen::Array4f squared = squared_distances(node, unit);
        open.push_children(node, lanes_not_negative(least * least - squared), squared);
    }
    return best;
}

}  // namespace graspd
