#include "floating_parts.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

#include "graspd/base/disjoint_sets.hpp"
#include "graspd/base/triangle_bvh.hpp"
#include "graspd/mesh/surface_distance.hpp"

namespace graspd::mesh_detail {
namespace {

// [1] Of the diagonal: pieces of one thing that were drawn side by side touch or nearly do.
constexpr double kApart = 0.01;
constexpr std::size_t kMostVertices = 20000;
constexpr double kRayTolerance = 1e-6;  // [1] of the diagonal

struct Part {
    TriangleMesh mesh;  ///< vertices: all of the whole mesh's
    Eigen::AlignedBox3d box;
    double area_m2 = 0.0;
};

double area_m2(const TriangleMesh& mesh, const Triangle& t) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    return 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
}

/// Pieces without a common vertex, in the order of their lowest vertex; faces alone.
std::vector<Part> split(const TriangleMesh& mesh) {
    DisjointSets sets(mesh.vertices.size());
    for (const Triangle& t : mesh.faces) {
        sets.unite(t[0], t[1]);
        sets.unite(t[1], t[2]);
    }
    std::vector<std::uint32_t> part_of(mesh.vertices.size(), 0);
    std::vector<Part> parts;
    for (std::uint32_t v = 0; v < part_of.size(); ++v) {
        const std::uint32_t name = sets.find(v);
        if (name == v) parts.emplace_back();
        part_of[v] = name == v ? static_cast<std::uint32_t>(parts.size() - 1) : part_of[name];
        parts[part_of[v]].box.extend(mesh.vertices[v]);
    }
    for (const Triangle& t : mesh.faces) {
        Part& part = parts[part_of[t[0]]];
        part.mesh.faces.push_back(t);
        part.area_m2 += area_m2(mesh, t);
    }
    return parts;
}

/// The largest part, as the others are measured against it.
struct MainPart {
    Eigen::AlignedBox3d box;
    SurfaceDistance surface;
    TriangleBvh tree;
};

/// Least distance of a part's vertices from the main part, 0 where they meet or it lies within; of
/// one face out of `stride`.
double gap_m(const Part& part, const std::vector<Eigen::Vector3d>& vertices, const MainPart& main,
             std::size_t stride) {
    const bool may_meet = part.box.intersects(main.box);
    if (may_meet && main.tree.contains(vertices[part.mesh.faces.front()[0]])) return 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < part.mesh.faces.size(); f += stride) {
        const Triangle& t = part.mesh.faces[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3d& from = vertices[t[k]];
            if (may_meet && main.tree.segment_blocked(from, vertices[t[(k + 1) % 3]])) return 0.0;
            least = std::min(least, main.surface.to(from, least));
        }
    }
    return least;
}

}  // namespace

std::optional<Finding> find_floating_parts(const TriangleMesh& mesh) {
    std::vector<Part> parts = split(mesh);
    if (parts.size() < 2) return std::nullopt;
    const auto largest = std::ranges::max_element(parts, {}, &Part::area_m2);
    largest->mesh.vertices = mesh.vertices;
    Eigen::AlignedBox3d box;
    double total_m2 = 0.0;
    for (const Part& part : parts) {
        box.extend(part.box);
        total_m2 += part.area_m2;
    }
    const double diagonal_m = box.diagonal().norm();
    const MainPart main{largest->box, SurfaceDistance(largest->mesh),
                        TriangleBvh(largest->mesh, kRayTolerance * diagonal_m)};
    const std::size_t stride = 1 + 3 * mesh.faces.size() / kMostVertices;
    std::size_t count = 0;
    double widest_m = 0.0, least_m2 = total_m2;
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        if (part == largest) continue;
        const double gap = gap_m(*part, mesh.vertices, main, stride);
        if (gap < kApart * diagonal_m) continue;
        ++count;
        widest_m = std::max(widest_m, gap);
        least_m2 = std::min(least_m2, part->area_m2);
    }
    if (count == 0) return std::nullopt;
    std::ostringstream text;
    text << count << " of " << parts.size() << " parts stand apart from the largest and are kept; "
         << "widest gap " << widest_m << " m, least share of the area "
         << 100.0 * least_m2 / total_m2 << " %";
    return Finding{"floating_parts", static_cast<double>(count), text.str()};
}

}  // namespace graspd::mesh_detail
