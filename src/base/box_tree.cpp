#include "graspd/base/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace graspd {
namespace {

constexpr int kBins = 12;
constexpr int kSahDepth = 64;  // below it the tree is halved by count: 28 more levels at most
static_assert(BoxTree::kStackDepth > 3 * (kSahDepth + 28) / 2 + 4);

std::uint32_t leaf_of(std::uint32_t first, std::uint32_t count) {
    return BoxTree::kLeafBit | (first << 3) | count;
}

float half_area(const Box4f& box) {
    const Eigen::Array4f s = box.high - box.low;
    return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

struct Item {
    Box4f box;
    std::uint32_t number = 0;

    Eigen::Array4f twice_center() const { return box.low + box.high; }
};

class Builder {
public:
    Builder(std::vector<Item>& items, std::vector<BoxTree::Node>& nodes)
        : items_(items), nodes_(nodes) {}

    /// @return the child that stands for items [first, last)
    std::uint32_t build(std::uint32_t first, std::uint32_t last, int depth) {
        if (last - first <= BoxTree::kLeafSize) return leaf_of(first, last - first);
        std::array<std::uint32_t, 5> border{first, first, 0, last, last};
        border[2] = split(first, last, depth);
        if (border[2] - first > BoxTree::kLeafSize) border[1] = split(first, border[2], depth + 1);
        if (last - border[2] > BoxTree::kLeafSize) border[3] = split(border[2], last, depth + 1);
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            set_bounds(nodes_[index], k, border[k], border[k + 1]);
            const bool empty = border[k] == border[k + 1];
            const std::uint32_t child =
                empty ? leaf_of(0, 0) : build(border[k], border[k + 1], depth + 2);
            nodes_[index].child[k] = child;
        }
        return index;
    }

private:
    void set_bounds(BoxTree::Node& node, std::size_t k, std::uint32_t first, std::uint32_t last) {
        Box4f box;
        for (std::uint32_t i = first; i < last; ++i) box.extend(items_[i].box);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<Eigen::Index>(axis), lane = static_cast<Eigen::Index>(k);
            node.bound[axis][0][lane] = box.low[a];
            node.bound[axis][1][lane] = box.high[a];
        }
    }

    /// Reorders items [first, last) and returns where the right part begins.
    std::uint32_t split(std::uint32_t first, std::uint32_t last, int depth) {
        Box4f centers;
        for (std::uint32_t i = first; i < last; ++i) {
            const Eigen::Array4f center = items_[i].twice_center();
            centers.extend({center, center});
        }
        Eigen::Index axis = 0;
        const float width = (centers.high - centers.low).head<3>().maxCoeff(&axis);
        if (depth >= kSahDepth || !(width > 0.0F)) return first + (last - first) / 2;
        const float low = centers.low[axis];
        const float factor = static_cast<float>(kBins) / width;
        const auto bin_of = [&](const Item& item) {
            const int bin = static_cast<int>((item.twice_center()[axis] - low) * factor);
            return std::min(bin, kBins - 1);
        };
        std::array<Box4f, kBins> boxes;
        std::array<std::uint32_t, kBins> counts{};
        for (std::uint32_t i = first; i < last; ++i) {
            const auto bin = static_cast<std::size_t>(bin_of(items_[i]));
            boxes[bin].extend(items_[i].box);
            ++counts[bin];
        }
        const int best = best_border(boxes, counts);
        const auto middle = std::partition(items_.begin() + first, items_.begin() + last,
                                           [&](const Item& i) { return bin_of(i) < best; });
        return static_cast<std::uint32_t>(middle - items_.begin());
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

    std::vector<Item>& items_;
    std::vector<BoxTree::Node>& nodes_;
};

}  // namespace

BoxTree build_box_tree(const std::vector<Box4f>& boxes) {
    assert(boxes.size() < (std::size_t{1} << 28));
    std::vector<Item> items;
    items.reserve(boxes.size());
    for (const Box4f& box : boxes) items.push_back({box, static_cast<std::uint32_t>(items.size())});
    BoxTree tree;
    tree.nodes.reserve(boxes.size() / 3 + 1);
    tree.root = Builder(items, tree.nodes).build(0, static_cast<std::uint32_t>(items.size()), 0);
    tree.order.reserve(items.size());
    for (const Item& item : items) tree.order.push_back(item.number);
    return tree;
}

}  // namespace graspd
