#include <algorithm>
#include <cassert>
#include <limits>

#include "graspd/concavity/outer_hull.hpp"
#include "hull_plane_walk.hpp"

namespace graspd {

using namespace concavity_detail;

namespace {

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
