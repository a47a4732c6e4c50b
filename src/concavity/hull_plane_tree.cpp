#include <algorithm>
#include <cassert>
#include <limits>

#include "graspd/base/lanes.hpp"
#include "graspd/concavity/outer_hull.hpp"

namespace graspd {
namespace {

// Boxes and planes are padded by what single precision may round away (coordinates stay below 1),
// so that nothing nearer than the best found is ever skipped.
constexpr float kPad = 1e-6F;
constexpr float kNever = std::numeric_limits<float>::infinity();

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

struct Waiting {
    std::uint32_t child;
    float distance;  ///< squared to the child's box, or along a ray
};

/// A walk's open ends, the nearest of each node's children on top.
class WaitingList {
public:
    explicit WaitingList(std::uint32_t root) { stack_[top_++] = {root, 0.0F}; }

    bool empty() const { return top_ == 0; }
    Waiting take() { return stack_[--top_]; }

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
    std::array<Waiting, BoxTree::kStackDepth> stack_;
    std::size_t top_ = 0;
};

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
        boxes.push_back({to_units(facet.box.min()) - kPad, to_units(facet.box.max()) + kPad});
    }
    tree_ = build_box_tree(boxes);
    if (BoxTree::is_leaf(tree_.root)) add_pack(tree_.root);
    for (BoxTree::Node& node : tree_.nodes) {
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
        least = static_cast<float>(distance / diagonal_m_) + kPad;
    };
    consider(hint);
    WaitingList open(tree_.root);
    while (!open.empty()) {
        const Waiting item = open.take();
        // The nearest plane's foot lies on its facet, hence in the facet's box.
        if (item.distance > least * least) continue;
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            unsigned lanes = lanes_not_negative(least + kPad - pack.distances(unit));
            while (lanes != 0) consider(pack.facet[take_lane(lanes)]);
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        const Eigen::Array4f squared = squared_distances(node, unit);
        open.push_children(node, lanes_not_negative(least * least - squared), squared);
    }
    return best;
}

void HullPlaneTree::facets_ahead(const Eigen::Vector3d& point, double limit_m,
                                 const Eigen::Vector3d& normal, double below, double beside_m,
                                 std::vector<std::uint32_t>& facets) const {
    facets.clear();
    const Eigen::Array4f unit = to_units(point);
    const Eigen::Array3f up = normal.cast<float>().array();
    const auto least_rise = static_cast<float>(-below);
    const float limit = static_cast<float>(limit_m / diagonal_m_) + kPad;
    const float beside = static_cast<float>(beside_m / diagonal_m_) + kPad;
    WaitingList open(tree_.root);
    while (!open.empty()) {
        const Waiting item = open.take();
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            const Eigen::Array4f distance = pack.distances(unit);
            const Eigen::Array4f rise =
                pack.normal[0] * up[0] + pack.normal[1] * up[1] + pack.normal[2] * up[2];
            Eigen::Array4f room = (limit + kPad - distance).min(rise - least_rise);
            if (lanes_not_negative(room) == 0) continue;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Eigen::Array4f foot =
                    unit[static_cast<Eigen::Index>(axis)] + distance * pack.normal[axis];
                room = room.min(beside + pack.extent[axis] - (foot - pack.center[axis]).abs());
            }
            unsigned lanes = lanes_not_negative(room);
            while (lanes != 0) facets.push_back(pack.facet[take_lane(lanes)]);
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        const Eigen::Array4f squared = squared_distances(node, unit);
        open.push_children(node, lanes_not_negative(limit * limit - squared), squared);
    }
}

std::uint32_t HullPlaneTree::exit(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const {
    const Eigen::Array4f start = to_units(origin);
    const Eigen::Vector3d unit = direction.normalized();
    std::array<float, 3> inverse{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr double kLeast = 1e-30;  // infinity times 0 is no number
        const double slope = unit[static_cast<Eigen::Index>(axis)];
        inverse[axis] = static_cast<float>(std::abs(slope) > kLeast ? 1.0 / slope : 1.0 / kLeast);
    }
    double nearest_m = std::numeric_limits<double>::infinity();
    float reach = kNever;  // nearest in units, padded
    std::uint32_t best = 0;
    WaitingList open(tree_.root);
    while (!open.empty()) {
        const Waiting item = open.take();
        // Where the ray leaves the hull is a point of that facet, hence in the facet's box.
        if (item.distance > reach) continue;
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            for (std::uint32_t k = 0; k < BoxTree::leaf_count(item.child); ++k) {
                const HullFacet& facet = facets_[pack.facet[k]];
                const double slope = facet.normal.dot(unit);
                if (!(slope > 0.0)) continue;
                const double there_m = (facet.offset_m - facet.normal.dot(origin)) / slope;
                const bool nearer =
                    there_m < nearest_m || (there_m == nearest_m && pack.facet[k] < best);
                if (!nearer) continue;
                nearest_m = there_m;
                best = pack.facet[k];
                reach = static_cast<float>(there_m / diagonal_m_) + kPad;
            }
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        Eigen::Array4f enter = Eigen::Array4f::Zero();
        Eigen::Array4f leave = Eigen::Array4f::Constant(reach);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = start[static_cast<Eigen::Index>(axis)];
            const Eigen::Array4f low = (node.bound[axis][0] - at) * inverse[axis];
            const Eigen::Array4f high = (node.bound[axis][1] - at) * inverse[axis];
            enter = enter.max(low.min(high));
            leave = leave.min(low.max(high));
        }
        open.push_children(node, lanes_not_negative(leave + kPad - enter), enter);
    }
    return best;
}

}  // namespace graspd
