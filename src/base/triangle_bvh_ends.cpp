#include <array>
#include <cassert>
#include <cstddef>

#include "triangle_bvh_ray.hpp"

// What a line meets first from both of its ends.

namespace graspd {
namespace {

/// A part of the tree that the line passes.
struct Waiting {
    std::uint32_t child;
    float enter, leave;  ///< [units] along the line
};

/// Those on top are looked at next.
struct WaitingStack {
    static constexpr std::size_t kRoom = BoxTree::kStackDepth;

    std::size_t size = 0;
    std::array<Waiting, 2 * kRoom> items;

    explicit WaitingStack() {}  // leaves the items as they are: most are never used

    bool has_room() const { return size < kRoom; }
    Waiting pop() { return items[--size]; }
    /// Under what of that above `bottom` is to be looked at sooner.
    template <class Sooner>
    void push(const Waiting& item, std::size_t bottom, Sooner&& sooner) {
        assert(size < items.size());
        std::size_t place = size++;
        for (; place > bottom && sooner(items[place - 1], item); --place) {
            items[place] = items[place - 1];
        }
        items[place] = item;
    }
};

constexpr auto kNearerToA = [](const Waiting& x, const Waiting& y) { return x.enter < y.enter; };
constexpr auto kNearerToB = [](const Waiting& x, const Waiting& y) { return x.leave > y.leave; };

}  // namespace

/// One walk along a line: what is nearest to `a` first, until nothing nearer is left; then what was
/// passed over by that, from `b`.
class TriangleBvh::EndWalk {
public:
    EndWalk(const TriangleBvh& bvh, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
            const Eigen::Vector3d& direction, double distance_m)
        : bvh_(bvh), ray_(a, direction, bvh), b_(b), distance_m_(distance_m) {}

    EndHits run() {
        if (!ray_.meets_bounds) return ends_;
        near_b_m_ = distance_m_;
        reach_ = from_a_ = ray_.units_to(distance_m_);
        stack_.push({bvh_.tree_.root, 0.0F, reach_}, 0, kNearerToA);
        while (stack_.size > 0) {
            const Waiting item = stack_.pop();
            if (item.enter > from_a_ && passed_.has_room()) {
                passed_.push(item, 0, kNearerToB);
            } else {
                look_from_a(item);
            }
        }
        while (passed_.size > 0) {
            const Waiting item = passed_.pop();
            if (item.leave >= from_b_) look_from_b(item);
        }
        // Last, as what stands first from a is seldom first from b.
        for (; met_count_ > 0; --met_count_) {
            const Met& met = met_[met_count_ - 1];
            if (met.to_b_m <= near_b_m_ + bvh_.tolerance_m_) meet_from_b(met.place);
        }
        return ends_;
    }

private:
    /// Calls visit(place) for each triangle of a leaf that the line may meet.
    template <class Visit>
    void each_near(std::uint32_t leaf, Visit&& visit) const {
        const Pack& pack = bvh_.packs_[BoxTree::leaf_first(leaf)];
        unsigned lanes = near_lanes(ray_, pack, reach_, bvh_.margin_);
        while (lanes != 0) visit(pack.first + take_lane(lanes));
    }
    template <class Sooner>
    void push_children(std::uint32_t node_index, WaitingStack& stack, Sooner&& sooner) const {
        const BoxTree::Node& node = bvh_.tree_.nodes[node_index];
        Eigen::Array4f enter, leave;
        unsigned lanes = ray_.enters(node, reach_, enter, leave);
        const std::size_t bottom = stack.size;
        while (lanes != 0) {
            const unsigned lane = take_lane(lanes);
            stack.push({node.child[lane], enter[lane], leave[lane]}, bottom, sooner);
        }
    }

    void look_from_a(const Waiting& item) {
        if (!BoxTree::is_leaf(item.child)) return push_children(item.child, stack_, kNearerToA);
        each_near(item.child, [&](std::uint32_t place) {
            Hit hit;
            if (!bvh_.meets(ray_.origin, ray_.direction, place, distance_m_, hit)) return;
            if (hit.keep_if_nearer(ends_.from_a)) from_a_ = ray_.units_to(hit.distance_m);
            if (met_count_ == met_.size()) return meet_from_b(place);
            met_[met_count_++] = {place, distance_m_ - hit.distance_m};
        });
    }
    void look_from_b(const Waiting& item) {
        if (!BoxTree::is_leaf(item.child)) return push_children(item.child, passed_, kNearerToB);
        each_near(item.child, [&](std::uint32_t place) { meet_from_b(place); });
    }
    void meet_from_b(std::uint32_t place) {
        Hit hit;
        if (!bvh_.meets(b_, -ray_.direction, place, near_b_m_, hit) ||
            !hit.keep_if_nearer(ends_.from_b)) {
            return;
        }
        near_b_m_ = hit.distance_m;
        from_b_ = ray_.units_to(distance_m_ - near_b_m_) / (Ray::kSlack * Ray::kSlack);
    }

    const TriangleBvh& bvh_;
    const Ray ray_;  ///< from a
    const Eigen::Vector3d& b_;
    const double distance_m_;
    EndHits ends_;
    double near_b_m_ = 0.0;  ///< [m] from b to its hit
    float reach_ = 0.0F;     ///< [units] along the ray, as the next two
    float from_a_ = 0.0F;    ///< what lies beyond is not met first from a
    float from_b_ = 0.0F;    ///< what lies before is not met first from b
    WaitingStack stack_, passed_;
    /// Triangles that were met on the way from a.
    struct Met {
        std::uint32_t place;
        double to_b_m;
    };
    std::array<Met, 16> met_;
    std::size_t met_count_ = 0;
};

TriangleBvh::EndHits TriangleBvh::hits_from_ends(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 const Eigen::Vector3d& direction,
                                                 double distance_m) const {
    return EndWalk(*this, a, b, direction, distance_m).run();
}

}  // namespace graspd
