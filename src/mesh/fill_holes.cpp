#include "fill_holes.hpp"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include "graspd/base/stop.hpp"
#include "graspd/base/stoppable_sort.hpp"
#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

/// A half-edge's number after its face is turned round or not: 0 and 2 change places, 1 stays.
std::uint32_t turned(std::uint32_t half, const std::vector<char>& flip) {
    return flip[half / 3] ? half - half % 3 + (2 - half % 3) : half;
}

/// Finds open edges among faces some of which are about to be turned round.
class OpenEdgeFinder {
public:
    OpenEdgeFinder(const TriangleMesh& mesh, const Orientation& patches)
        : mesh_(mesh), faces_(mesh.faces), patches_(patches) {}

    /// Edges with one face, or with two that stay at odds.
    void add_simple(const MeshEdges& edges) {
        if (edges.open_edges == 0 && !edges.at_odds) return;
        for (std::uint32_t half = 0; half < edges.across.size(); ++half) {
            stop_point(half);
            const std::uint32_t other = edges.across[half];
            if (other == kNone || other < half) continue;
            if (other == half) {
                add(half, direction(half));
            } else if (edges.at_odds && direction(half) == direction(other)) {
                add(half, 2 * direction(half));
                open_.seam_m +=
                    (mesh_.vertices[tail_of(faces_, half)] - mesh_.vertices[head_of(faces_, half)])
                        .norm();
            }
        }
    }

    /// Edges with more faces, in the order of the turned half-edges.
    void add_crowded(std::vector<CrowdedHalf> crowded, DisjointSets& groups) {
        const auto key = [&](const CrowdedHalf& each) {
            return CrowdedHalf{turned(each.edge, patches_.flip), turned(each.half, patches_.flip)};
        };
        stoppable_sort(crowded,
                       [&](const CrowdedHalf& a, const CrowdedHalf& b) { return key(a) < key(b); });
        surplus_of_patch_.resize(patches_.patches);
        for (std::size_t begin = 0, end = 0; begin < crowded.size(); begin = end) {
            stop_point();
            while (end < crowded.size() && crowded[end].edge == crowded[begin].edge) ++end;
            balance(std::span(crowded).subspan(begin, end - begin), groups);
        }
    }

    OpenEdges take() { return std::move(open_); }

private:
    std::uint32_t patch_of(std::uint32_t half) const { return patches_.patch_of_face[half / 3]; }

    /// +1 where the face, turned or not, runs from the lower to the higher vertex; else -1.
    std::int64_t direction(std::uint32_t half) const {
        return rises(faces_, half) != (patches_.flip[half / 3] != 0) ? 1 : -1;
    }

    /// Adds `surplus` open edges (negative: falling ones) along a half-edge's edge.
    void add(std::uint32_t half, std::int64_t surplus, std::uint32_t patch = kNone) {
        if (patch == kNone) patch = patch_of(half);
        const auto [low, high] = std::minmax({tail_of(faces_, half), head_of(faces_, half)});
        for (; surplus > 0; --surplus) open_.edges.push_back({low, high, patch});
        for (; surplus < 0; ++surplus) open_.edges.push_back({high, low, patch});
    }

    /// Balance of each patch on one crowded edge: a patch that is balanced by itself closes without
    /// the others; those that are not belong together.
    void balance(std::span<const CrowdedHalf> edge, DisjointSets& groups) {
        std::int64_t surplus = 0;
        for (const auto& [first_half, half] : edge) {
            surplus_of_patch_[patch_of(half)] += direction(half);
            surplus += direction(half);
        }
        std::uint32_t first = kNone;  // a patch that is not balanced
        std::uint32_t owner = kNone;  // one that is unbalanced in the direction of the sum
        for (const auto& [first_half, half] : edge) {
            const std::uint32_t patch = patch_of(half);
            if (surplus_of_patch_[patch] == 0) continue;
            if (first == kNone) first = patch;
            groups.unite(first, patch);
            if (owner == kNone && (surplus_of_patch_[patch] > 0) == (surplus > 0)) owner = patch;
        }
        add(edge.front().half, surplus, owner);
        for (const auto& [first_half, half] : edge) surplus_of_patch_[patch_of(half)] = 0;
    }

    const TriangleMesh& mesh_;
    const std::vector<Triangle>& faces_;
    const Orientation& patches_;
    std::vector<std::int64_t> surplus_of_patch_;
    OpenEdges open_;
};

Eigen::Vector3d centroid_of_loop(const std::vector<OpenEdge>& open,
                                 const std::vector<std::uint32_t>& loop,
                                 const std::vector<Eigen::Vector3d>& vertices) {
    // Relative to a vertex of the loop: far from the origin the sums would lose digits.
    const Eigen::Vector3d& base = vertices[open[loop.front()].from];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double length_m = 0.0;
    for (const std::uint32_t i : loop) {
        const Eigen::Vector3d a = vertices[open[i].from] - base;
        const Eigen::Vector3d b = vertices[open[i].to] - base;
        sum += 0.5 * (b - a).norm() * (a + b);
        length_m += (b - a).norm();
    }
    return length_m > 0.0 ? Eigen::Vector3d(base + sum / length_m) : base;
}

}  // namespace

OpenEdges find_open_edges(const TriangleMesh& mesh, const MeshEdges& edges,
                          const Orientation& patches, DisjointSets& groups) {
    OpenEdgeFinder finder(mesh, patches);
    finder.add_simple(edges);
    finder.add_crowded(edges.crowded, groups);
    return finder.take();
}

std::vector<std::vector<std::uint32_t>> walk_loops(const std::vector<OpenEdge>& open,
                                                   std::size_t vertex_count) {
    std::vector<std::vector<std::uint32_t>> loops;
    if (open.empty()) return loops;
    std::vector<std::uint32_t> first(vertex_count, kNone);  // of the edges that start at a vertex
    std::vector<std::uint32_t> next(open.size(), kNone);
    for (std::uint32_t i = static_cast<std::uint32_t>(open.size()); i-- > 0;) {
        next[i] = first[open[i].from];
        first[open[i].from] = i;
    }
    std::vector<std::uint32_t> place(vertex_count, kNone);  // on the path, of the edge leaving it
    std::vector<std::uint32_t> path;
    for (const OpenEdge& start : open) {
        std::uint32_t at = start.from;
        while (first[at] != kNone || !path.empty()) {
            if (place[at] != kNone) {  // back where the path has been: cut the loop off
                const std::uint32_t begin = place[at];
                loops.emplace_back(path.begin() + begin, path.end());
                for (const std::uint32_t i : loops.back()) place[open[i].from] = kNone;
                path.resize(begin);
                continue;
            }
            stop_point(path.size());
            const std::uint32_t edge = first[at];
            assert(edge != kNone);  // as many open edges start at a vertex as end there
            first[at] = next[edge];
            place[at] = static_cast<std::uint32_t>(path.size());
            path.push_back(edge);
            at = open[edge].to;
        }
    }
    return loops;
}

HoleFill fill_holes(const std::vector<OpenEdge>& open,
                    const std::vector<std::vector<std::uint32_t>>& loops, TriangleMesh& mesh,
                    std::vector<std::uint32_t>& patch_of_face, DisjointSets& groups) {
    HoleFill fill;
    const auto add_face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c,
                              std::uint32_t patch) {
        mesh.faces.push_back({a, b, c});
        patch_of_face.push_back(patch);
        fill.area_m2 +=
            0.5 *
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
    };
    for (const std::vector<std::uint32_t>& loop : loops) {
        stop_point();
        const std::uint32_t patch = open[loop.front()].patch;
        for (const std::uint32_t i : loop) groups.unite(patch, open[i].patch);
        if (loop.size() == 3) {
            add_face(open[loop[0]].from, open[loop[2]].from, open[loop[1]].from, patch);
            continue;
        }
        const std::uint32_t centre = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(centroid_of_loop(open, loop, mesh.vertices));
        ++fill.vertices;
        for (const std::uint32_t i : loop) add_face(open[i].to, open[i].from, centre, patch);
    }
    return fill;
}

}  // namespace graspd::mesh_detail
