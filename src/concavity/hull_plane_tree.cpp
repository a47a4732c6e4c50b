#include <algorithm>
#include <cassert>
#include <limits>

#include "graspd/base/lanes.hpp"
#include "graspd/base/stop.hpp"
#include "graspd/concavity/outer_hull.hpp"

namespace graspd {
namespace {

// Boxes and planes are padded by what single precision may round away (coordinates stay below 1),
// so that nothing nearer than the best found is ever skipped.
constexpr float kPlanePad = 1e-6F;
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

/// The few least of many values.
template <std::size_t kMost>
class LeastValues {
public:
    explicit LeastValues(std::size_t wanted) : wanted_(wanted) {}

    void note(float value) {
        if (count_ == wanted_ && value >= least_[count_ - 1]) return;
        std::size_t place = count_ < wanted_ ? count_++ : count_ - 1;
        for (; place > 0 && value < least_[place - 1]; --place) least_[place] = least_[place - 1];
        least_[place] = value;
    }
    /// The greatest of them; infinite while they are fewer than wanted.
    float worst() const { return count_ == wanted_ ? least_[count_ - 1] : kNever; }

private:
    std::array<float, kMost> least_;
    std::size_t wanted_, count_ = 0;
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

/// Side by side, four a place.
struct HullPlaneTree::Vicinity {
    static constexpr std::size_t kMost = 128;

    struct Quad {
        std::array<Eigen::Array4f, 3> normal;
        Eigen::Array4f offset;

        Eigen::Array4f distances(const Eigen::Array4f& unit) const {
            return offset - normal[0] * unit[0] - normal[1] * unit[1] - normal[2] * unit[2];
        }
    };
    std::array<Quad, kMost / 4> quads;
    std::array<std::uint32_t, kMost> facet;
    std::size_t count = 0;

    void add(const Pack& pack, unsigned lane) {
        const auto from = static_cast<Eigen::Index>(lane);
        const auto to = static_cast<Eigen::Index>(count % 4);
        Quad& quad = quads[count / 4];
        if (to == 0) quad.offset = Eigen::Array4f::Constant(kNever);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (to == 0) quad.normal[axis] = Eigen::Array4f::Zero();
            quad.normal[axis][to] = pack.normal[axis][from];
        }
        quad.offset[to] = pack.offset[from];
        facet[count++] = pack.facet[lane];
    }
};

/// All planes that may be the nearest of a point in a ball: no plane's distance changes by more
/// than the way between two points.
/// @param near  a facet that is near: no other one farther from all of the ball is of interest
/// @return false where they are too many
bool HullPlaneTree::gather(const Eigen::Vector3d& middle, double radius_m, std::uint32_t near,
                           Vicinity& vicinity) const {
    vicinity.count = 0;
    const Eigen::Array4f unit = to_units(middle);
    const double near_m = std::max(0.0, facets_[near].offset_m - facets_[near].normal.dot(middle));
    const float limit =
        static_cast<float>((near_m + 2.0 * radius_m) / diagonal_m_) + 2.0F * kPlanePad;
    WaitingList open(tree_.root);
    while (!open.empty()) {
        const WaitingPlanes item = open.take();
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            unsigned lanes = lanes_not_negative(limit - pack.distances(unit));
            while (lanes != 0) {
                if (vicinity.count == Vicinity::kMost) return false;
                vicinity.add(pack, take_lane(lanes));
            }
            continue;
        }
        const BoxTree::Node& node = tree_.nodes[item.child];
        const Eigen::Array4f squared = squared_distances(node, unit);
        open.push_children(node, lanes_not_negative(limit * limit - squared), squared);
    }
    return true;
}

HullPlaneTree::Nearest HullPlaneTree::nearest_of(const Vicinity& vicinity,
                                                 const Eigen::Vector3d& point) const {
    const Eigen::Array4f unit = to_units(point);
    const std::size_t quads = (vicinity.count + 3) / 4;
    std::array<Eigen::Array4f, Vicinity::kMost / 4> distances;
    Eigen::Array4f least = Eigen::Array4f::Constant(kNever);
    for (std::size_t q = 0; q < quads; ++q) {
        distances[q] = vicinity.quads[q].distances(unit);
        least = least.min(distances[q]);
    }
    const float limit = std::max(0.0F, least.minCoeff()) + 2.0F * kPlanePad;
    Nearest best{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t q = 0; q < quads; ++q) {
        unsigned lanes = lanes_not_negative(limit - distances[q]);
        while (lanes != 0) {
            const std::uint32_t index = vicinity.facet[4 * q + take_lane(lanes)];
            const HullFacet& facet = facets_[index];
            const double distance_m = std::max(0.0, facet.offset_m - facet.normal.dot(point));
            const bool nearer = distance_m < best.distance_m ||
                                (distance_m == best.distance_m && index < best.facet);
            if (nearer) best = {distance_m, index};
        }
    }
    return best;
}

void HullPlaneTree::nearest(std::span<const Eigen::Vector3d> points,
                            std::span<Nearest> nearest) const {
    constexpr std::size_t kGroup = 16;        // points that share a vicinity
    constexpr std::size_t kLongestWait = 15;  // groups until vicinities are tried again
    std::size_t wait = 0, next_wait = 1;
    std::uint32_t hint = 0;
    Vicinity vicinity;
    for (std::size_t first = 0; first < points.size(); first += kGroup) {
        const std::size_t last = std::min(points.size(), first + kGroup);
        Eigen::AlignedBox3d box;
        for (std::size_t i = first; i < last; ++i) box.extend(points[i]);
        nearest[first] = this->nearest(points[first], hint);
        hint = nearest[first].facet;
        const bool is_tried = wait == 0;
        const bool is_shared =
            is_tried && gather(box.center(), 0.5 * box.diagonal().norm(), hint, vicinity);
        for (std::size_t i = first + 1; i < last; ++i) {
            nearest[i] =
                is_shared ? nearest_of(vicinity, points[i]) : this->nearest(points[i], hint);
            hint = nearest[i].facet;
        }
        if (!is_tried) --wait;
        if (is_shared) next_wait = 1;
        if (is_tried && !is_shared) {
            wait = next_wait;
            next_wait = std::min(2 * next_wait + 1, kLongestWait);
        }
    }
}

void HullPlaneTree::facets_ahead(const Eigen::Vector3d& point, double limit_m,
                                 const Eigen::Vector3d& normal, double below, double beside_m,
                                 std::size_t most, std::vector<std::uint32_t>& facets) const {
    assert(most >= 1 && most <= kMostAhead);
    facets.clear();
    LeastValues<kMostAhead> nearest(most);
    const Eigen::Array4f unit = to_units(point);
    const Eigen::Array3f up = normal.cast<float>().array();
    const auto least_rise = static_cast<float>(-below);
    float limit = static_cast<float>(limit_m / diagonal_m_) + 2.0F * kPlanePad;
    const float beside = static_cast<float>(beside_m / diagonal_m_) + kPlanePad;
    WaitingList open(tree_.root);
    while (!open.empty()) {
        const WaitingPlanes item = open.take();
        if (item.distance > limit * limit) continue;
        if (BoxTree::is_leaf(item.child)) {
            const Pack& pack = packs_[BoxTree::leaf_first(item.child)];
            const Eigen::Array4f distance = pack.distances(unit);
            const Eigen::Array4f rise =
                pack.normal[0] * up[0] + pack.normal[1] * up[1] + pack.normal[2] * up[2];
            Eigen::Array4f room = (limit - distance).min(rise - least_rise);
            if (lanes_not_negative(room) == 0) continue;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Eigen::Array4f foot =
                    unit[static_cast<Eigen::Index>(axis)] + distance * pack.normal[axis];
                room = room.min(beside + pack.extent[axis] - (foot - pack.center[axis]).abs());
            }
            unsigned lanes = lanes_not_negative(room);
            while (lanes != 0) {
                const unsigned lane = take_lane(lanes);
                facets.push_back(pack.facet[lane]);
                nearest.note(distance[lane]);
            }
            limit = std::min(limit, nearest.worst() + 2.0F * kPlanePad);
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
        const WaitingPlanes item = open.take();
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
                reach = static_cast<float>(there_m / diagonal_m_) + kPlanePad;
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
        open.push_children(node, lanes_not_negative(leave + kPlanePad - enter), enter);
    }
    return best;
}

}  // namespace graspd
