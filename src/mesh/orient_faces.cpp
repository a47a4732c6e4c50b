#include "orient_faces.hpp"

#include <span>
#include <utility>

#include "graspd/base/stop.hpp"
#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

/// Visits the patch of `seed`.
/// @param queue  (F) room for the faces of the patch
/// @return how many these are
std::size_t spread_over_patch(const std::vector<Triangle>& faces, const MeshEdges& edges,
                              std::uint32_t seed, Orientation& result,
                              std::vector<std::uint32_t>& queue) {
    std::size_t count = 1;
    queue[0] = seed;
    result.patch_of_face[seed] = result.patches;
    for (std::size_t next = 0; next < count; ++next) {
        stop_point(next);
        const std::uint32_t face = queue[next];
        for (std::uint32_t half = 3 * face; half < 3 * face + 3; ++half) {
            const std::uint32_t other = edges.across[half];
            if (other == kNone) continue;
            const std::uint32_t neighbour = other / 3;  // the face itself at a boundary
            if (result.patch_of_face[neighbour] != kNone) continue;
            result.patch_of_face[neighbour] = result.patches;
            queue[count++] = neighbour;
            if (!edges.at_odds) continue;
            const bool at_odds = rises(faces, half) == rises(faces, other);
            result.flip[neighbour] = static_cast<char>(result.flip[face] != char{at_odds});
        }
    }
    return count;
}

/// Turns the choice round when it would flip most of the patch.
std::uint32_t keep_majority(std::span<const std::uint32_t> patch, std::vector<char>& flip) {
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
    std::vector<std::uint32_t> queue(faces.size());
    for (std::uint32_t seed = 0; seed < faces.size(); ++seed) {
        stop_point(seed);
        if (result.patch_of_face[seed] != kNone) continue;
        const std::size_t count = spread_over_patch(faces, edges, seed, result, queue);
        if (edges.at_odds) {
            result.flipped += keep_majority(std::span(queue).first(count), result.flip);
        }
        ++result.patches;
    }
    return result;
}

void turn_faces(const std::vector<char>& flip, std::vector<Triangle>& faces) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (flip[f]) std::swap(faces[f][1], faces[f][2]);
    }
}

}  // namespace graspd::mesh_detail
