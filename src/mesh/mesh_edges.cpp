#include "mesh_edges.hpp"

#include <algorithm>
#include <memory>

#include "graspd/base/stop.hpp"
#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

/// A half-edge in the bucket of its lower vertex.
struct Entry {
    std::uint32_t high;   ///< its other vertex
    std::uint32_t half2;  ///< 2 half-edge + (1 when it rises); 3 * 2^28 faces fit

    std::uint32_t half() const { return half2 >> 1; }
};

/// Half-edges by their lower vertex, in rising order. Neighbours in a mesh are mostly neighbours in
/// memory, so buckets stay in the cache where a hash table of edges would not.
struct Buckets {
    std::vector<std::uint32_t> end;  ///< (V) bucket v ends at end[v], where bucket v + 1 begins
    std::unique_ptr<Entry[]> entries;

    Buckets(const std::vector<Triangle>& faces, std::size_t vertex_count) : end(vertex_count, 0) {
        for (const Triangle& face : faces) {
            ++end[std::min(face[0], face[1])];
            ++end[std::min(face[1], face[2])];
            ++end[std::min(face[2], face[0])];
        }
        std::uint32_t sum = 0;
        for (std::uint32_t& each : end) {  // now where the bucket begins; filling moves it on
            const std::uint32_t size = each;
            each = sum;
            sum += size;
        }
        stop_point();
        entries = std::make_unique_for_overwrite<Entry[]>(sum);
        std::uint32_t half2 = 0;
        const auto add = [&](std::uint32_t from, std::uint32_t to) {
            const bool rising = from < to;
            entries[end[rising ? from : to]++] = {rising ? to : from, half2 + rising};
            half2 += 2;
        };
        for (std::size_t f = 0; f < faces.size(); ++f) {
            stop_point(f);
            const Triangle& face = faces[f];
            add(face[0], face[1]);
            add(face[1], face[2]);
            add(face[2], face[0]);
        }
    }
};

/// The half-edges of the bucket [begin, end) that share their edge with two or more others.
void gather_crowded(const Entry* entries, std::uint32_t begin, std::uint32_t end,
                    std::vector<std::uint32_t>& first_on, MeshEdges& result) {
    for (std::uint32_t i = begin; i < end; ++i) {
        if (result.across[entries[i].half()] != kNone) continue;
        const std::uint32_t first = first_on[entries[i].high];
        result.crowded.push_back({entries[first].half(), entries[i].half()});
    }
}

}  // namespace

MeshEdges collect_edges(const std::vector<Triangle>& faces, std::size_t vertex_count) {
    MeshEdges result;
    result.across.resize(3 * faces.size());
    const Buckets buckets(faces, vertex_count);
    stop_point();
    const Entry* const entries = buckets.entries.get();
    // Per higher vertex the first entry of an edge to it. What an earlier bucket wrote lies before
    // this bucket's begin, so nothing needs to be wiped.
    std::vector<std::uint32_t> first_on(vertex_count, kNone);
    std::uint32_t begin = 0;
    std::size_t vertex = 0;
    for (const std::uint32_t end : buckets.end) {
        stop_point(vertex++);
        const std::size_t crowded_before = result.crowded_edges;
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t half = entries[i].half();
            const std::uint32_t first = first_on[entries[i].high];
            if (first < begin || first >= i) {
                first_on[entries[i].high] = i;
                result.across[half] = half;
                ++result.open_edges;
                continue;
            }
            const std::uint32_t other = entries[first].half();
            std::uint32_t& beyond = result.across[other];
            if (beyond == other) {
                beyond = half;
                result.across[half] = other;
                --result.open_edges;
                result.at_odds |= ((entries[i].half2 ^ entries[first].half2) & 1u) == 0;
                continue;
            }
            if (beyond != kNone) {  // the third
                result.across[beyond] = kNone;
                beyond = kNone;
                ++result.crowded_edges;
            }
            result.across[half] = kNone;
        }
        if (result.crowded_edges > crowded_before) {
            gather_crowded(entries, begin, end, first_on, result);
        }
        begin = end;
    }
    return result;
}

}  // namespace graspd::mesh_detail
