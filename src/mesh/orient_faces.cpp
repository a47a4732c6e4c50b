#include "orient_faces.hpp"

#include <utility>

#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

/// Visits the patch of `seed`; `queue` receives its faces.
void spread_over_patch(const std::vector<Triangle>& faces, const MeshEdges& edges,
                       std::uint32_t seed, Orientation& result, std::vector<std::uint32_t>& queue) {
    queue.assign(1, seed);
    result.patch_of_face[seed] = result.patches;
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const std::uint32_t face = queue[next];
        for (std::uint32_t half = 3 * face; half < 3 * face + 3; ++half) {
            const MeshEdge& edge = edges.edges[edges.edge_of_half[half]];
            if (edge.count != 2) continue;
            const std::uint32_t other = edge.half[0] == half ? edge.half[1] : edge.half[0];
            const std::uint32_t neighbour = other / 3;
            if (result.patch_of_face[neighbour] != kNone) continue;
            result.patch_of_face[neighbour] = result.patches;
            const bool at_odds = rises(faces, half) == rises(faces, other);
            result.flip[neighbour] = static_cast<char>(result.flip[face] != char{at_odds});
            queue.push_back(neighbour);
        }
    }
}

/// Turns the choice round when it would flip most of the patch.
std::uint32_t keep_majority(const std::vector<std::uint32_t>& patch, std::vector<char>& flip) {
    std::uint32_t flipped = 0;
    for (const std::uint32_t face : patch) flipped += flip[face] != 0;
    if (2 * std::size_t{flipped} <= patch.size()) return flipped;
    for (const std::uint32_t face : patch) flip[face] = static_cast<char>(!flip[face]);
    return static_cast<std::uint32_t>(patch.size()) - flipped;
}

}  // namespace

Orientation orient_faces(const std::vector<Triangle>& faces, const MeshEdges& edges) {
    Orientation result;
    result.patch_of_face.assign(faces.size(), kNone);
    result.flip.assign(faces.size(), 0);
    std::vector<std::uint32_t> queue;
    queue.reserve(faces.size());
    for (std::uint32_t seed = 0; seed < faces.size(); ++seed) {
        if (result.patch_of_face[seed] != kNone) continue;
        spread_over_patch(faces, edges, seed, result, queue);
        result.flipped += keep_majority(queue, result.flip);
        ++result.patches;
    }
    return result;
}

void turn_faces(const std::vector<char>& flip, std::vector<Triangle>& faces, MeshEdges& edges) {
    // (a, b, c) becomes (a, c, b): half-edges 0 and 2 change places, 1 stays, all turn round.
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (!flip[f]) continue;
        std::swap(faces[f][1], faces[f][2]);
        std::swap(edges.edge_of_half[3 * f], edges.edge_of_half[3 * f + 2]);
    }
    for (MeshEdge& edge : edges.edges) {
        for (std::uint32_t& half : edge.half) {
            if (flip[half / 3]) half = half - half % 3 + (2 - half % 3);
        }
    }
}

}  // namespace graspd::mesh_detail
