#include <algorithm>
#include <limits>

#include "graspd/concavity/outer_hull.hpp"
#include "hull_plane_walk.hpp"

namespace graspd {

using namespace concavity_detail;

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

}  // namespace graspd
