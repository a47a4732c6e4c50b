#include "clean_faces.hpp"

#include <algorithm>

#include "hash_bits.hpp"
#include "weld_vertices.hpp"

namespace graspd::mesh_detail {
namespace {

std::vector<char> vertices_in_use(const TriangleMesh& soup) {
    std::vector<char> in_use(soup.vertices.size(), 0);
    for (const Triangle& face : soup.faces) {
        for (const std::uint32_t vertex : face) in_use[vertex] = 1;
    }
    return in_use;
}

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

/// Faces on the leaders' indices; counts what it drops.
void keep_faces(const TriangleMesh& soup, const std::vector<std::uint32_t>& leader,
                CleanFaces& result) {
    FaceSet seen(soup.faces.size());
    result.mesh.faces.reserve(soup.faces.size());
    for (const Triangle& face : soup.faces) {
        const Triangle welded{leader[face[0]], leader[face[1]], leader[face[2]]};
        if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) {
            ++result.degenerate;
        } else if (!seen.insert(welded)) {
            ++result.duplicate;
        } else {
            result.mesh.faces.push_back(welded);
        }
    }
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
    for (Triangle& face : result.mesh.faces) {
        for (std::uint32_t& vertex : face) vertex = static_cast<std::uint32_t>(index[vertex]);
    }
    result.vertex_of_input.resize(soup.vertices.size());
    for (std::size_t i = 0; i < index.size(); ++i) {
        result.vertex_of_input[i] = index[leader[i]];
        result.welded += leader[i] != i;
        result.unreferenced += index[leader[i]] < 0;
    }
}

}  // namespace

CleanFaces clean_faces(const TriangleMesh& soup, double tolerance_m) {
    CleanFaces result;
    const std::vector<std::uint32_t> leader =
        weld_vertices(soup.vertices, vertices_in_use(soup), tolerance_m);
    keep_faces(soup, leader, result);
    renumber(soup, leader, result);
    return result;
}

}  // namespace graspd::mesh_detail
