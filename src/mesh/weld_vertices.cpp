#include "weld_vertices.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

using Cell = std::array<std::int64_t, 3>;

std::uint64_t hash_of(const Cell& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t index : cell) {
        key = spread_bits(key ^ static_cast<std::uint64_t>(index));
    }
    return key;
}

/// The leaders found so far, in hash buckets chained through `next_`.
class LeaderGrid {
public:
    LeaderGrid(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& low_corner,
               double tolerance_m)
        : vertices_(vertices),
          low_corner_(low_corner),
          tolerance_m_(tolerance_m),
          mask_(std::bit_ceil(vertices.size() + 1) - 1),
          head_(mask_ + 1, kNone),
          next_(vertices.size(), kNone) {}

    /// The leader of vertex `index`; makes it a leader when there is none.
    std::uint32_t find_or_add(std::uint32_t index) {
        Cell near;  // the neighbouring cell that the tolerance reaches into, per axis
        const Cell home = cell_of(vertices_[index], near);
        std::uint32_t best = kNone;
        for (unsigned corner = 0; corner < 8; ++corner) {
            Cell cell = home;
            bool distinct = true;
            for (unsigned axis = 0; axis < 3; ++axis) {
                if (!(corner >> axis & 1u)) continue;
                distinct = distinct && near[axis] != home[axis];
                cell[axis] = near[axis];
            }
            if (distinct) best = std::min(best, find_in(cell, index));
        }
        if (best != kNone) return best;
        std::uint32_t& bucket = head_[hash_of(home) & mask_];
        next_[index] = bucket;
        bucket = index;
        return index;
    }

private:
    // Eight tolerances wide: a vertex looks into two cells on average, and only some hundred
    // leaders, each a tolerance from the others, fit into one.
    static constexpr double kCellWidths = 8.0;

    Cell cell_of(const Eigen::Vector3d& vertex, Cell& near) const {
        Cell cell;
        for (unsigned axis = 0; axis < 3; ++axis) {
            if (tolerance_m_ == 0.0) {
                cell[axis] = near[axis] = std::bit_cast<std::int64_t>(vertex[axis] + 0.0);
                continue;
            }
            const double place = (vertex[axis] - low_corner_[axis]) / (kCellWidths * tolerance_m_);
            const double whole = std::floor(place);
            const double reach = 1.01 / kCellWidths;  // rounding of `place` cannot hide a neighbour
            cell[axis] = static_cast<std::int64_t>(whole);
            near[axis] = cell[axis] - (place - whole < reach) + (place - whole > 1.0 - reach);
        }
        return cell;
    }

    std::uint32_t find_in(const Cell& cell, std::uint32_t index) const {
        const double limit = tolerance_m_ * tolerance_m_;
        std::uint32_t best = kNone;
        for (std::uint32_t i = head_[hash_of(cell) & mask_]; i != kNone; i = next_[i]) {
            if ((vertices_[i] - vertices_[index]).squaredNorm() <= limit) best = std::min(best, i);
        }
        return best;
    }

    const std::vector<Eigen::Vector3d>& vertices_;
    Eigen::Vector3d low_corner_;
    double tolerance_m_;
    std::size_t mask_;
    std::vector<std::uint32_t> head_;
    std::vector<std::uint32_t> next_;
};

}  // namespace

std::vector<std::uint32_t> weld_vertices(const std::vector<Eigen::Vector3d>& vertices,
                                         const std::vector<char>& in_use, double tolerance_m) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (in_use[i]) box.extend(vertices[i]);
    }
    LeaderGrid grid(vertices, box.min(), tolerance_m);
    std::vector<std::uint32_t> leader(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        leader[i] = in_use[i] ? grid.find_or_add(i) : i;
    }
    return leader;
}

}  // namespace graspd::mesh_detail
