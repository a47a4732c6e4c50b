#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace graspd::mesh_detail {

/// Marks an empty slot of the open-addressing tables of this folder.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Spreads the bits of a key (the finaliser of splitmix64, Steele et al. 2014).
inline std::uint64_t spread_bits(std::uint64_t key) {
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ULL;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebULL;
    return key ^ (key >> 31);
}

/// Slots of a table for `entries` keys: a power of two, at most three quarters full.
inline std::size_t table_size(std::size_t entries) {
    return std::bit_ceil(entries + entries / 3 + 2);
}

}  // namespace graspd::mesh_detail
