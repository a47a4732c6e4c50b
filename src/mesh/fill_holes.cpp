#include "fill_holes.hpp"

#include <cassert>

#include "hash_bits.hpp"

namespace graspd::mesh_detail {
namespace {

/// Half-edges of the edges with more than two faces, grouped by edge.
std::vector<std::vector<std::uint32_t>> crowded_edges(const MeshEdges& edges) {
    std::vector<std::uint32_t> group_of_edge(edges.edges.size(), kNone);
    std::vector<std::vector<std::uint32_t>> groups;
    for (std::uint32_t half = 0; half < edges.edge_of_half.size(); ++half) {
        const std::uint32_t edge = edges.edge_of_half[half];
        if (edges.edges[edge].count <= 2) continue;
        if (group_of_edge[edge] == kNone) {
            group_of_edge[edge] = static_cast<std::uint32_t>(groups.size());
            groups.emplace_back();
        }
        groups[group_of_edge[edge]].push_back(half);
    }
    return groups;
}

/// Adds `surplus` open edges (negative: falling ones) along an edge.
void add_open(const MeshEdge& edge, std::int64_t surplus, std::uint32_t patch,
              std::vector<OpenEdge>& open) {
    for (; surplus > 0; --surplus) open.push_back({edge.low, edge.high, patch});
    for (; surplus < 0; ++surplus) open.push_back({edge.high, edge.low, patch});
}

/// Balance of each patch on one crowded edge: a patch that is balanced by itself closes without
/// the others; those that are not belong together.
void balance_crowded_edge(const std::vector<Triangle>& faces, const MeshEdges& edges,
                          const std::vector<std::uint32_t>& halves, const Orientation& patches,
                          std::vector<std::int64_t>& surplus_of_patch, DisjointSets& groups,
                          std::vector<OpenEdge>& open) {
    std::int64_t surplus = 0;
    for (const std::uint32_t half : halves) {
        const std::int64_t direction = rises(faces, half) ? 1 : -1;
        surplus_of_patch[patches.patch_of_face[half / 3]] += direction;
        surplus += direction;
    }
    std::uint32_t first = kNone;  // a patch that is not balanced
    std::uint32_t owner = kNone;  // one that is unbalanced in the direction of the sum
    for (const std::uint32_t half : halves) {
        const std::uint32_t patch = patches.patch_of_face[half / 3];
        if (surplus_of_patch[patch] == 0) continue;
        if (first == kNone) first = patch;
        groups.unite(first, patch);
        if (owner == kNone && (surplus_of_patch[patch] > 0) == (surplus > 0)) owner = patch;
    }
    add_open(edges.edges[edges.edge_of_half[halves.front()]], surplus, owner, open);
    for (const std::uint32_t half : halves) surplus_of_patch[patches.patch_of_face[half / 3]] = 0;
}

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

std::vector<OpenEdge> find_open_edges(const std::vector<Triangle>& faces, const MeshEdges& edges,
                                      const Orientation& patches, DisjointSets& groups) {
    std::vector<OpenEdge> open;
    for (const MeshEdge& edge : edges.edges) {
        if (edge.count > 2) continue;
        std::int64_t surplus = 0;
        for (std::uint32_t k = 0; k < edge.count; ++k) {
            surplus += rises(faces, edge.half[k]) ? 1 : -1;
        }
        add_open(edge, surplus, patches.patch_of_face[edge.half[0] / 3], open);
    }
    std::vector<std::int64_t> surplus_of_patch(patches.patches, 0);
    for (const std::vector<std::uint32_t>& halves : crowded_edges(edges)) {
        balance_crowded_edge(faces, edges, halves, patches, surplus_of_patch, groups, open);
    }
    return open;
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
