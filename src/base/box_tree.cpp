#include "graspd/base/box_tree.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>
#include <utility>

#include "graspd/base/space_curve.hpp"
#include "graspd/base/stop.hpp"

namespace graspd {
namespace {

constexpr int kBins = 12;
constexpr std::uint32_t kClusterSize = 8;  // things that the surface area heuristic moves as one
constexpr int kSahDepth = 32;              // below it clusters are halved by count
constexpr int kMostHalvings = 28;          // of 2^28 things
static_assert(BoxTree::kStackDepth >=
              3 * (kSahDepth + kMostHalvings + CurvePlace::kBits + kMostHalvings) / 2 + 4);

std::vector<CurvePlace> place_on_curve(const std::vector<Box4f>& boxes) {
    std::vector<Eigen::Array4f> centers;
    centers.reserve(boxes.size());
    for (const Box4f& box : boxes) centers.push_back(0.5F * (box.low + box.high));
    return order_on_curve(centers);
}

float half_area(const Box4f& box) {
    const Eigen::Array4f s = box.high - box.low;
    return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

/// Neighbours on the curve, things [first, last), that stay together near the root.
struct Cluster {
    Box4f box;
    std::uint32_t first = 0, last = 0;

    Eigen::Array4f twice_center() const { return box.low + box.high; }
    std::uint32_t count() const { return last - first; }
};

class Builder {
public:
    explicit Builder(const std::vector<Box4f>& boxes)
        : boxes_(boxes), things_(place_on_curve(boxes)) {}

    BoxTree build() {
        const auto count = static_cast<std::uint32_t>(things_.size());
        tree_.nodes.reserve(count / 3 + 1);
        tree_.order.reserve(count);
        clusters_.reserve(count / 4 + 1);
        form_clusters(0, count);
        if (count > 0) {
            tree_.root = build_part({0, static_cast<std::uint32_t>(clusters_.size()), true}, 0);
        }
        return std::move(tree_);
    }

private:
    /// Clusters, or things where a single cluster is left.
    struct Part {
        std::uint32_t first = 0, last = 0;
        bool of_clusters = false;

        bool empty() const { return first == last; }
    };

    void form_clusters(std::uint32_t first, std::uint32_t last) {
        if (last - first > kClusterSize && things_[first].code != things_[last - 1].code) {
            const std::uint32_t middle = split_curve(first, last);
            form_clusters(first, middle);
            form_clusters(middle, last);
        } else if (first < last) {
            stop_point(clusters_.size());
            clusters_.push_back({box_of_things(first, last), first, last});
        }
    }

    /// Where the highest bit that differs among things [first, last) turns to 1; the middle where
    /// none differs.
    std::uint32_t split_curve(std::uint32_t first, std::uint32_t last) const {
        const std::uint32_t differing = things_[first].code ^ things_[last - 1].code;
        if (differing == 0) return first + (last - first) / 2;
        const std::uint32_t bit = std::bit_floor(differing);
        const auto turn =
            std::partition_point(things_.begin() + first, things_.begin() + last,
                                 [&](const CurvePlace& thing) { return (thing.code & bit) == 0; });
        return static_cast<std::uint32_t>(turn - things_.begin());
    }

    Part narrowed(Part part) const {
        if (!part.of_clusters || part.last - part.first != 1) return part;
        return {clusters_[part.first].first, clusters_[part.first].last, false};
    }

    bool fits_leaf(const Part& part) const {
        return !part.of_clusters && part.last - part.first <= BoxTree::kLeafSize;
    }

    /// Two parts; the second is empty when the first fits a leaf.
    std::pair<Part, Part> split(const Part& part, int depth) {
        if (fits_leaf(part)) return {part, Part{part.last, part.last, false}};
        const std::uint32_t middle = part.of_clusters ? split_clusters(part.first, part.last, depth)
                                                      : split_curve(part.first, part.last);
        return {narrowed({part.first, middle, part.of_clusters}),
                narrowed({middle, part.last, part.of_clusters})};
    }

    /// @return the child that stands for a part that is not empty
    std::uint32_t build_part(Part part, int depth) {
        part = narrowed(part);
        if (fits_leaf(part)) return add_leaf(part);
        const auto [left, right] = split(part, depth);
        const auto [first, second] = split(left, depth + 1);
        const auto [third, fourth] = split(right, depth + 1);
        const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        std::size_t lane = 0;
        for (const Part& child : {first, second, third, fourth}) {
            set_bounds(tree_.nodes[index], lane, child);
            const std::uint32_t built =
                child.empty() ? BoxTree::kLeafBit : build_part(child, depth + 2);
            tree_.nodes[index].child[lane++] = built;
        }
        return index;
    }

    std::uint32_t add_leaf(const Part& part) {
        stop_point(++leaves_);
        const auto first = static_cast<std::uint32_t>(tree_.order.size());
        for (std::uint32_t i = part.first; i < part.last; ++i) {
            tree_.order.push_back(things_[i].number);
        }
        return BoxTree::kLeafBit | first << 3 | (part.last - part.first);
    }

    Box4f box_of_things(std::uint32_t first, std::uint32_t last) const {
        Box4f box;
        for (std::uint32_t i = first; i < last; ++i) box.extend(boxes_[things_[i].number]);
        return box;
    }

    void set_bounds(BoxTree::Node& node, std::size_t lane, const Part& part) const {
        Box4f box;
        if (part.of_clusters) {
            for (std::uint32_t i = part.first; i < part.last; ++i) box.extend(clusters_[i].box);
        } else {
            box = box_of_things(part.first, part.last);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis), l = static_cast<Eigen::Index>(lane);
            node.bound[axis][0][l] = box.low[a];
            node.bound[axis][1][l] = box.high[a];
        }
    }

    /// Reorders clusters [first, last), two or more, and returns where the right part begins.
    std::uint32_t split_clusters(std::uint32_t first, std::uint32_t last, int depth) {
        const std::span<Cluster> part(clusters_.data() + first, last - first);
        Box4f centers;
        for (const Cluster& cluster : part) {
            centers.extend({cluster.twice_center(), cluster.twice_center()});
        }
        Eigen::Index axis = 0;
        const float width = (centers.high - centers.low).head<3>().maxCoeff(&axis);
        const bool apart = width > 0.0F && std::isfinite(width);
        if (depth >= kSahDepth || !apart) return first + (last - first) / 2;
        const float low = centers.low[axis];
        const float factor = static_cast<float>(kBins) / width;
        const auto bin_of = [&](const Cluster& cluster) {
            const float place = (cluster.twice_center()[axis] - low) * factor;
            if (!(place > 0.0F)) return 0;  // also a NaN: too far for a float
            return place < static_cast<float>(kBins) ? static_cast<int>(place) : kBins - 1;
        };
        if (part.size() > 1024) stop_point();
        std::array<Box4f, kBins> boxes;
        std::array<std::uint32_t, kBins> counts{};
        for (const Cluster& cluster : part) {
            const auto bin = static_cast<std::size_t>(bin_of(cluster));
            boxes[bin].extend(cluster.box);
            counts[bin] += cluster.count();
        }
        const int best = best_border(boxes, counts);
        // Not of std::ranges: clang 14 cannot read the subrange that this gives.
        const auto right = std::partition(part.begin(), part.end(),
                                          [&](const Cluster& c) { return bin_of(c) < best; });
        return static_cast<std::uint32_t>(right - part.begin()) + first;
    }

    /// The first bin of the right part. The first and the last bin are never empty.
    static int best_border(const std::array<Box4f, kBins>& boxes,
                           const std::array<std::uint32_t, kBins>& counts) {
        std::array<float, kBins> right_cost{};
        Box4f swept;
        std::uint32_t count = 0;
        for (std::size_t bin = kBins - 1; bin > 0; --bin) {
            swept.extend(boxes[bin]);
            count += counts[bin];
            right_cost[bin] = half_area(swept) * static_cast<float>(count);
        }
        swept = Box4f();
        count = 0;
        int best = 1;
        float best_cost = std::numeric_limits<float>::infinity();
        for (std::size_t bin = 1; bin < kBins; ++bin) {
            swept.extend(boxes[bin - 1]);
            count += counts[bin - 1];
            const float cost = half_area(swept) * static_cast<float>(count) + right_cost[bin];
            if (cost < best_cost) {
                best_cost = cost;
                best = static_cast<int>(bin);
            }
        }
        return best;
    }

    const std::vector<Box4f>& boxes_;
    std::vector<CurvePlace> things_;
    std::vector<Cluster> clusters_;
    std::size_t leaves_ = 0;
    BoxTree tree_;
};

}  // namespace

BoxTree build_box_tree(const std::vector<Box4f>& boxes) {
    assert(boxes.size() < (std::size_t{1} << 28));
    return Builder(boxes).build();
}

}  // namespace graspd
