#include "weld_vertices.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "graspd/base/stop.hpp"
#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

// Odd numbers without pattern (the hexadecimal digits of pi): a cell's key is the sum of its
// indices times these, so that the key of a neighbour on one axis is known from that axis alone.
constexpr std::array<std::uint64_t, 3> kAxisFactor = {0x243f6a8885a308d3, 0x13198a2e03707345,
                                                      0xa4093822299f31d1};

/// A vertex's cell, and per axis the neighbouring one that the tolerance reaches into (or the
/// same), as terms of keys.
struct Place {
    std::array<std::uint64_t, 3> home;
    std::array<std::uint64_t, 3> near;
};

/// The leaders found so far, in hash buckets chained through `links_`.
class LeaderGrid {
public:
    LeaderGrid(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& low_corner,
               double tolerance_m)
        : vertices_(vertices),
          low_corner_(low_corner),
          tolerance_m_(tolerance_m),
          per_cell_(1.0 / (kCellWidths * tolerance_m)),
          mask_(std::bit_ceil(2 * vertices.size()) - 1),
          head_(mask_ + 1, kNone),
          links_(vertices.size()) {}

    Place place_of(std::uint32_t index) const {
        Place place;
        for (unsigned axis = 0; axis < 3; ++axis) {
            std::int64_t home = 0, near = 0;
            if (tolerance_m_ == 0.0) {
                home = near = std::bit_cast<std::int64_t>(vertices_[index][axis] + 0.0);
            } else {
                const double exact = (vertices_[index][axis] - low_corner_[axis]) * per_cell_;
                home = static_cast<std::int64_t>(exact);  // not negative
                const double rest = exact - static_cast<double>(home);
                constexpr double kReach = 1.01 / kCellWidths;  // rounding cannot hide a neighbour
                near = home - (rest < kReach) + (rest > 1.0 - kReach);
            }
            place.home[axis] = static_cast<std::uint64_t>(home) * kAxisFactor[axis];
            place.near[axis] = static_cast<std::uint64_t>(near) * kAxisFactor[axis];
        }
        return place;
    }

    /// Asks for the memory that find_or_add is going to look at.
    void prefetch(const Place& place) const {
        __builtin_prefetch(
            &head_[spread_bits(place.home[0] + place.home[1] + place.home[2]) & mask_]);
    }

    /// The leader of vertex `index`; makes it a leader when there is none.
    std::uint32_t find_or_add(std::uint32_t index, const Place& place) {
        const auto& [home, near] = place;
        unsigned reaches = 0;  // axes with a neighbour
        for (unsigned axis = 0; axis < 3; ++axis) {
            reaches |= static_cast<unsigned>(near[axis] != home[axis]) << axis;
        }
        const std::uint64_t hash = spread_bits(home[0] + home[1] + home[2]);
        std::uint32_t best = find_in(hash, index);
        for (unsigned corner = 1; corner < 8 && reaches != 0; ++corner) {
            if ((corner & ~reaches) != 0) continue;
            std::uint64_t key = 0;
            for (unsigned axis = 0; axis < 3; ++axis) {
                key += corner >> axis & 1u ? near[axis] : home[axis];
            }
            best = std::min(best, find_in(spread_bits(key), index));
        }
        if (best != kNone) return best;
        std::uint32_t& bucket = head_[hash & mask_];
        links_[index] = {bucket, tag_of(hash)};
        bucket = index;
        return index;
    }

private:
    // Eight tolerances wide: a vertex looks into two cells on average, and only some hundred
    // leaders, each a tolerance from the others, fit into one.
    static constexpr double kCellWidths = 8.0;

    struct Link {
        std::uint32_t next;  ///< leader in the same bucket
        std::uint32_t tag;   ///< of the leader's cell
    };

    static std::uint32_t tag_of(std::uint64_t hash) {
        return static_cast<std::uint32_t>(hash >> 32);
    }

    std::uint32_t find_in(std::uint64_t hash, std::uint32_t index) const {
        const double limit = tolerance_m_ * tolerance_m_;
        std::uint32_t best = kNone;
        for (std::uint32_t i = head_[hash & mask_]; i != kNone; i = links_[i].next) {
            if (links_[i].tag != tag_of(hash)) continue;  // of another cell
            if ((vertices_[i] - vertices_[index]).squaredNorm() <= limit) best = std::min(best, i);
        }
        return best;
    }

    const std::vector<Eigen::Vector3d>& vertices_;
    Eigen::Vector3d low_corner_;
    double tolerance_m_;
    double per_cell_;  ///< [1/m]
    std::size_t mask_;
    std::vector<std::uint32_t> head_;
    std::vector<Link> links_;
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
    constexpr std::uint32_t kBlock = 16;  // vertices whose memory is on its way at the same time
    std::array<Place, kBlock> places;
    const std::uint32_t count = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t begin = 0; begin < count; begin += kBlock) {
        stop_point(begin);
        const std::uint32_t end = std::min(count, begin + kBlock);
        for (std::uint32_t i = begin; i < end; ++i) {
            if (!in_use[i]) continue;
            places[i - begin] = grid.place_of(i);
            grid.prefetch(places[i - begin]);
        }
        for (std::uint32_t i = begin; i < end; ++i) {
            leader[i] = in_use[i] ? grid.find_or_add(i, places[i - begin]) : i;
        }
    }
    return leader;
}

}  // namespace graspd::mesh_detail
