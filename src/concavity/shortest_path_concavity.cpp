#include "graspd/concavity/shortest_path_concavity.hpp"

#include <cmath>
#include <string>

#include "path_search.hpp"

namespace graspd {

const char* to_string(ConcavityFlag flag) {
    switch (flag) {
        case ConcavityFlag::kExact: return "exact";
        case ConcavityFlag::kPath: return "path";
        case ConcavityFlag::kEnclosed: return "enclosed";
        case ConcavityFlag::kUnreferenced: return "unreferenced";
    }
    return "unknown";
}

double mesh_diagonal_m(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.faces) {
        for (const std::uint32_t v : t) box.extend(mesh.vertices[v]);
    }
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

Result<ConcavityField> shortest_path_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                               const TriangleBvh& bvh,
                                               const ConcavityConfig& config) {
    if (mesh.faces.empty() || hull.facets.empty()) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "concavity needs a mesh with faces and its hull, got " +
                             std::to_string(mesh.faces.size()) + " faces and " +
                             std::to_string(hull.facets.size()) + " hull facets"};
    }
    concavity_detail::PathSearch search(mesh, hull, bvh, config);
    search.mark_unreferenced();
    search.prove_direct();
    search.propagate_inwards();
    search.reach_what_no_edge_reaches();
    search.shorten_across_the_void();
    return search.take();
}

std::vector<Eigen::Vector3d> escape_path(const TriangleMesh& mesh, const OuterHull& hull,
                                         const ConcavityField& field, std::uint32_t vertex) {
    std::vector<Eigen::Vector3d> path;
    if (!std::isfinite(field.value_m[vertex])) return path;
    if (field.parent[vertex] == ConcavityField::kNoParent) return path;  // a value without a way
    std::int32_t at = static_cast<std::int32_t>(vertex);
    while (at >= 0 && path.size() <= mesh.vertices.size()) {
        path.push_back(mesh.vertices[at]);
        at = field.parent[at];
    }
    if (at != ConcavityField::kNoParent) {
        const HullFacet& facet = hull.facets[static_cast<std::size_t>(-1 - at)];
        const double gap = facet.offset_m - facet.normal.dot(path.back());
        path.push_back(path.back() + gap * facet.normal);
    }
    return path;
}

}  // namespace graspd
