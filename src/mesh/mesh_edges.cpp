#include "mesh_edges.hpp"

#include <utility>

#include "hash_bits.hpp"

namespace graspd::mesh_detail {

MeshEdges collect_edges(const std::vector<Triangle>& faces) {
    MeshEdges result;
    const std::uint32_t halves = static_cast<std::uint32_t>(3 * faces.size());
    result.edge_of_half.resize(halves);
    result.edges.reserve(halves / 2 + 8);
    std::vector<std::uint32_t> table(table_size(halves), kNone);
    const std::size_t mask = table.size() - 1;
    for (std::uint32_t half = 0; half < halves; ++half) {
        std::uint32_t low = tail_of(faces, half);
        std::uint32_t high = head_of(faces, half);
        if (low > high) std::swap(low, high);
        std::size_t slot = spread_bits(std::uint64_t{low} << 32 | high) & mask;
        while (table[slot] != kNone &&
               (result.edges[table[slot]].low != low || result.edges[table[slot]].high != high)) {
            slot = (slot + 1) & mask;
        }
        if (table[slot] == kNone) {
            table[slot] = static_cast<std::uint32_t>(result.edges.size());
            result.edges.push_back({low, high, {half, half}, 0});
        }
        MeshEdge& edge = result.edges[table[slot]];
        if (edge.count == 1) edge.half[1] = half;
        ++edge.count;
        result.edge_of_half[half] = table[slot];
    }
    return result;
}

}  // namespace graspd::mesh_detail
