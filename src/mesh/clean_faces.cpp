#include "clean_faces.hpp"

#include <algorithm>

#include "graspd/base/stop.hpp"
#include "hash_bits.hpp"
#include "weld_vertices.hpp"

namespace graspd::mesh_detail {
namespace {

/// The faces seen so far, by their corners in rising order.
class FaceSet {
public:
    explicit FaceSet(std::size_t faces) : table_(table_size(faces), kNone) {
        sorted_.reserve(faces);
    }

    /// False when a face with these corners is there already.
    bool insert(Triangle corners) {
        if (corners[0] > corners[1]) std::swap(corners[0], corners[1]);
        if (corners[1] > corners[2]) std::swap(corners[1], corners[2]);
        if (corners[0] > corners[1]) std::swap(corners[0], corners[1]);
        const std::uint64_t low = std::uint64_t{corners[0]} << 32 | corners[1];
        const std::size_t mask = table_.size() - 1;
        std::size_t slot = spread_bits(spread_bits(low) ^ corners[2]) & mask;
        for (; table_[slot] != kNone; slot = (slot + 1) & mask) {
            if (sorted_[table_[slot]] == corners) return false;
        }
        table_[slot] = static_cast<std::uint32_t>(sorted_.size());
        sorted_.push_back(corners);
        return true;
    }

private:
    std::vector<std::uint32_t> table_;
    std::vector<Triangle> sorted_;
};

/// Faces on the leaders' indices, without those that have two equal corners.
void keep_faces(const TriangleMesh& soup, const std::vector<std::uint32_t>& leader,
                CleanFaces& result) {
    result.mesh.faces.reserve(soup.faces.size());
    for (const Triangle& face : soup.faces) {
        const Triangle welded{leader[face[0]], leader[face[1]], leader[face[2]]};
        if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) {
            ++result.degenerate;
        } else {
            result.mesh.faces.push_back(welded);
        }
    }
}

/// Faces that may have the corners of another one. Such a face has the other one alone across an
/// edge, or the edge is crowded; of three edges two are of the same kind, and show the same number.
/// 1 marks them; empty when there are none.
std::vector<char> possible_duplicates(const MeshEdges& edges) {
    std::vector<char> marked;
    const std::size_t faces = edges.across.size() / 3;
    for (std::size_t face = 0; face < faces; ++face) {
        const std::uint32_t* across = &edges.across[3 * face];
        const std::uint32_t a = across[0] / 3, b = across[1] / 3, c = across[2] / 3;
        if (a != b && b != c && c != a) continue;
        if ((a == b ? a : c) == face) continue;  // two open edges
        marked.resize(faces, 0);
        marked[face] = 1;
    }
    return marked;
}

/// Drops faces with the corners of an earlier one. Their vertices stay in use, by that one.
void drop_duplicates(CleanFaces& result) {
    const std::vector<char> possible = possible_duplicates(result.edges);
    if (possible.empty()) return;
    stop_point();
    FaceSet seen(static_cast<std::size_t>(std::ranges::count(possible, 1)));
    std::vector<Triangle>& faces = result.mesh.faces;
    std::size_t kept = 0;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        stop_point(face);
        if (possible[face] && !seen.insert(faces[face])) continue;
        faces[kept++] = faces[face];
    }
    result.duplicate = static_cast<std::uint32_t>(faces.size() - kept);
    if (result.duplicate == 0) return;
    faces.resize(kept);
    result.edges = collect_edges(faces, result.mesh.vertices.size());
}

/// Numbers the vertices that the kept faces use, in the order of the input.
void renumber(const TriangleMesh& soup, const std::vector<std::uint32_t>& leader,
              CleanFaces& result) {
    std::vector<std::int32_t> index(soup.vertices.size(), -1);
    for (const Triangle& face : result.mesh.faces) {
        for (const std::uint32_t vertex : face) index[vertex] = 0;
    }
    result.mesh.vertices.reserve(soup.vertices.size());
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (index[i] < 0) continue;
        index[i] = static_cast<std::int32_t>(result.mesh.vertices.size());
        result.mesh.vertices.push_back(soup.vertices[i]);
    }
    if (result.mesh.vertices.size() < soup.vertices.size()) {
        for (Triangle& face : result.mesh.faces) {
            for (std::uint32_t& vertex : face) vertex = static_cast<std::uint32_t>(index[vertex]);
        }
    }
    result.vertex_of_input.resize(soup.vertices.size());
    for (std::size_t i = 0; i < index.size(); ++i) {
        result.vertex_of_input[i] = index[leader[i]];
        result.welded += leader[i] != i;
        result.unreferenced += index[leader[i]] < 0;
    }
}

}  // namespace

CleanFaces clean_faces(const TriangleMesh& soup, const std::vector<char>& in_use,
                       double tolerance_m) {
    CleanFaces result;
    const std::vector<std::uint32_t> leader = weld_vertices(soup.vertices, in_use, tolerance_m);
    stop_point();
    keep_faces(soup, leader, result);
    stop_point();
    renumber(soup, leader, result);
    result.edges = collect_edges(result.mesh.faces, result.mesh.vertices.size());
    stop_point();
    drop_duplicates(result);
    return result;
}

}  // namespace graspd::mesh_detail
