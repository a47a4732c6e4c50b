#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "triangle_bvh_ray.hpp"

// What the lines of a grid meet first from both of their ends.

namespace graspd {
namespace {

// Single precision rounds by 6e-8; a coordinate has come through some ten roundings at the most.
constexpr double kPad = 2e-6;

/// Four boxes of the tree side by side: along each axis twice their middles, and their sizes.
struct FourBoxes {
    std::array<Eigen::Array4f, 3> twice_middle, size;

    explicit FourBoxes(const BoxTree::Node& node) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& [low, high] = node.bound[axis];
            twice_middle[axis] = low + high;
            size[axis] = high - low;
        }
    }
};
struct Extents {
    Eigen::Array4f low, high;
};

/// A scale along one of the grid's axes: `per_unit` marks a unit of the tree.
class Scale {
public:
    /// @param zero  [units] along the axis, where the scale begins; what rounds by `pad` [units] or
    ///              less is within the extents
    Scale(const Eigen::Vector3d& axis, double zero, double per_unit, double pad) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double half = 0.5 * per_unit * axis[static_cast<Eigen::Index>(i)];
            along_[i].setConstant(static_cast<float>(half));
            spread_[i].setConstant(static_cast<float>(std::abs(half)));
        }
        offset_.setConstant(static_cast<float>(-zero * per_unit));
        pad_.setConstant(static_cast<float>(pad * per_unit));
    }
    Extents of(const FourBoxes& boxes) const {
        const auto& [x, y, z] = boxes.twice_middle;
        const auto& [a, b, c] = boxes.size;
        const Eigen::Array4f middle = x * along_[0] + y * along_[1] + z * along_[2] + offset_;
        const Eigen::Array4f half = a * spread_[0] + b * spread_[1] + c * spread_[2] + pad_;
        return {middle - half, middle + half};
    }

private:
    std::array<Eigen::Array4f, 3> along_, spread_;
    Eigen::Array4f offset_, pad_;
};

/// Numbers the lines along one side of the grid.
class Side {
public:
    /// @param middle  [units] along the axis, of the grid
    Side(const Eigen::Vector3d& axis, double middle, std::span<const double> places_m,
         double units_per_m, double pad)
        : scale_(axis, middle + places_m.front() * units_per_m, per_unit(places_m, units_per_m),
                 pad) {
        last_.setConstant(static_cast<float>(places_m.size() - 1));
    }
    /// The first and the last line that come by each box; where none does, the first is above the
    /// last.
    Extents lines_by(const FourBoxes& boxes) const {
        const Extents extents = scale_.of(boxes);
        return {extents.low.ceil().max(0.0F), extents.high.floor().min(last_)};
    }

private:
    static double per_unit(std::span<const double> places_m, double units_per_m) {
        const double length = (places_m.back() - places_m.front()) * units_per_m;
        return length > 0.0 ? static_cast<double>(places_m.size() - 1) / length : 1.0;
    }
    Scale scale_;
    Eigen::Array4f last_;
};

/// A leaf that lines come by.
struct PassedLeaf {
    std::uint32_t pack;
    float near, far;  ///< [units] along the lines, from their middles
    std::uint32_t first_y, last_y, first_z, last_z;  ///< numbers of the lines
};

}  // namespace

/// One walk down the tree for all lines, which notes what leaves they come by; then each of these
/// with each of its lines.
class TriangleBvh::GridWalk {
public:
    GridWalk(const TriangleBvh& bvh, const LineGrid& grid)
        : bvh_(bvh),
          grid_(grid),
          length_m_(2.0 * grid.half_length_m),
          middle_(grid.pose.linear().transpose() * (grid.pose.translation() - bvh.middle_) *
                  bvh.units_per_m_),
          pad_(kPad * (1.0 + middle_.norm() + reach_m(grid) * bvh.units_per_m_)),
          x_(grid.pose.linear().col(0), middle_.x(), 1.0, pad_),
          y_(grid.pose.linear().col(1), middle_.y(), grid.y_m, bvh.units_per_m_, pad_),
          z_(grid.pose.linear().col(2), middle_.z(), grid.z_m, bvh.units_per_m_, pad_) {}

    std::vector<EndHits> run() {
        find_leaves();
        std::vector<EndHits> ends(grid_.y_m.size() * grid_.z_m.size());
        if (leaves_.empty()) return ends;
        start_lines();
        for (const PassedLeaf& leaf : leaves_) {
            for (std::uint32_t y = leaf.first_y; y <= leaf.last_y; ++y) {
                for (std::uint32_t z = leaf.first_z; z <= leaf.last_z; ++z) {
                    const std::size_t line = y * grid_.z_m.size() + z;
                    try_leaf(leaf, lines_[line], ends[line]);
                }
            }
        }
        for (std::size_t i = 0; i < ends.size(); ++i) {
            for (std::size_t k = 0; k < lines_[i].met_count; ++k) {
                meet_from_b(lines_[i], lines_[i].met[k], ends[i]);
            }
        }
        return ends;
    }

private:
    struct Line {
        Ray ray;  ///< from a
        Eigen::Vector3d b;
        float reach;                                           ///< [units] along the ray
        float first = std::numeric_limits<float>::infinity();  ///< [units] from the middle: what
        float last = -std::numeric_limits<float>::infinity();  ///< lies between is met first from
                                                               ///< neither end
        double last_m = 0.0;  ///< [m] from a to the last triangle that is met on the way
        std::array<std::uint32_t, 8> met{};  ///< places of triangles there
        std::uint32_t met_count = 0;
    };

    /// [m] no place of the grid is further from its middle.
    static double reach_m(const LineGrid& grid) {
        double sum = grid.half_length_m;
        for (const auto& places_m : {grid.y_m, grid.z_m}) {
            sum += std::max(std::abs(places_m.front()), std::abs(places_m.back()));
        }
        return sum;
    }

    void find_leaves() {
        if (bvh_.packs_.empty()) return;
        leaves_.reserve(256);
        const auto lines_y = static_cast<std::uint32_t>(grid_.y_m.size());
        const auto lines_z = static_cast<std::uint32_t>(grid_.z_m.size());
        if (BoxTree::is_leaf(bvh_.tree_.root)) {
            constexpr float kAnywhere = std::numeric_limits<float>::infinity();
            leaves_.push_back({BoxTree::leaf_first(bvh_.tree_.root), -kAnywhere, kAnywhere, 0,
                               lines_y - 1, 0, lines_z - 1});
            return;
        }
        const float half_length = static_cast<float>(grid_.half_length_m * bvh_.units_per_m_);
        std::array<std::uint32_t, BoxTree::kStackDepth> stack;
        std::size_t top = 0;
        stack[top++] = bvh_.tree_.root;
        while (top > 0) {
            const BoxTree::Node& node = bvh_.tree_.nodes[stack[--top]];
            const FourBoxes boxes(node);
            const Extents x = x_.of(boxes), y = y_.lines_by(boxes), z = z_.lines_by(boxes);
            // What is computed of a child that is not there is no number: its size says so.
            unsigned lanes = lanes_not_negative((half_length - x.low).min(x.high + half_length)) &
                             lanes_not_negative((y.high - y.low).min(z.high - z.low)) &
                             lanes_not_negative(boxes.size[0]);
            assert(top + 4 <= stack.size());
            while (lanes != 0) {
                const unsigned lane = take_lane(lanes);
                const std::uint32_t child = node.child[lane];
                if (!BoxTree::is_leaf(child)) {
                    stack[top++] = child;
                    continue;
                }
                const auto number = [&](const Eigen::Array4f& lines) {
                    return static_cast<std::uint32_t>(static_cast<std::int32_t>(lines[lane]));
                };
                leaves_.push_back({BoxTree::leaf_first(child), x.low[lane], x.high[lane],
                                   number(y.low), number(y.high), number(z.low), number(z.high)});
            }
        }
    }

    void start_lines() {
        const Eigen::Vector3d direction = grid_.pose.linear().col(0);
        Ray ray(direction, bvh_);
        lines_.reserve(grid_.y_m.size() * grid_.z_m.size());
        for (const double y : grid_.y_m) {
            for (const double z : grid_.z_m) {
                const Eigen::Vector3d a = grid_.pose * Eigen::Vector3d(-grid_.half_length_m, y, z);
                ray.start_at(a, bvh_);
                lines_.push_back({ray, grid_.pose * Eigen::Vector3d(grid_.half_length_m, y, z),
                                  ray.units_to(length_m_)});
            }
        }
    }

    void try_leaf(const PassedLeaf& leaf, Line& line, EndHits& ends) const {
        if (!line.ray.meets_bounds || (leaf.near > line.first && leaf.far < line.last)) return;
        const Pack& pack = bvh_.packs_[leaf.pack];
        unsigned lanes = near_lanes(line.ray, pack, line.reach, bvh_.margin_);
        while (lanes != 0) {
            const std::uint32_t place = pack.first + take_lane(lanes);
            Hit hit;
            if (!bvh_.meets(line.ray.origin, line.ray.direction, place, length_m_, hit)) continue;
            if (hit.keep_if_nearer(ends.from_a)) line.first = units_of(hit, pad_);
            note(line, place, hit, ends);
        }
    }
    float units_of(const Hit& hit, double pad) const {
        return static_cast<float>((hit.distance_m - grid_.half_length_m) * bvh_.units_per_m_ + pad);
    }

    /// Notes a triangle that is met on the way from a, if it may be the first one from b.
    void note(Line& line, std::uint32_t place, const Hit& hit, EndHits& ends) const {
        const double ahead_m = hit.distance_m - line.last_m;
        if (line.met_count > 0 && ahead_m < -bvh_.tolerance_m_) return;
        if (ahead_m > bvh_.tolerance_m_) line.met_count = 0;
        if (line.met_count == 0 || ahead_m > 0.0) {
            line.last_m = hit.distance_m;
            line.last = units_of(hit, -pad_);
        }
        if (line.met_count == line.met.size()) return meet_from_b(line, place, ends);
        line.met[line.met_count++] = place;
    }
    void meet_from_b(const Line& line, std::uint32_t place, EndHits& ends) const {
        Hit hit;
        if (bvh_.meets(line.b, -line.ray.direction, place, length_m_, hit)) {
            hit.keep_if_nearer(ends.from_b);
        }
    }

    const TriangleBvh& bvh_;
    const LineGrid& grid_;
    const double length_m_;
    const Eigen::Vector3d middle_;  ///< [units] of the lines, along the grid's axes
    const double pad_;              ///< [units] for roundings
    const Scale x_;
    const Side y_, z_;
    std::vector<PassedLeaf> leaves_;
    std::vector<Line> lines_;
};

std::vector<TriangleBvh::EndHits> TriangleBvh::hits_from_ends(const LineGrid& grid) const {
    if (grid.y_m.empty() || grid.z_m.empty()) return {};
    return GridWalk(*this, grid).run();
}

}  // namespace graspd
