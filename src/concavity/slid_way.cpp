#include <algorithm>

#include "slide_bends.hpp"

namespace graspd::concavity_detail {

void take_slid(const SlidWay& way, std::uint32_t vertex, ConcavityField& field) {
    field.value_m[vertex] = way.value_m;
    if (way.bends.empty()) {  // all of them dropped
        field.parent[vertex] = way.parent;
        return;
    }
    const auto first = static_cast<std::int32_t>(field.value_m.size() + field.edge_bends.size());
    for (std::size_t i = 0; i < way.bends.size(); ++i) {
        field.edge_bends.push_back(way.bends[i]);
        field.edge_bends.back().parent =
            i + 1 == way.bends.size() ? way.parent : first + 1 + static_cast<std::int32_t>(i);
    }
    field.parent[vertex] = first;
}

double length_of_way(const ConcavityField& field, const PathGround& ground,
                     const HullPlaneTree& planes, std::uint32_t vertex) {
    const auto vertices = static_cast<std::int32_t>(field.value_m.size());
    Eigen::Vector3d at = ground.mesh.vertices[vertex];
    std::int32_t parent = field.parent[vertex];
    double length_m = 0.0;
    while (parent >= vertices) {
        const EdgeBend& bend = field.edge_bends[static_cast<std::size_t>(parent - vertices)];
        length_m += (bend.point - at).norm();
        at = bend.point;
        parent = bend.parent;
    }
    if (parent >= 0) {
        return length_m + (ground.mesh.vertices[static_cast<std::size_t>(parent)] - at).norm() +
               field.value_m[static_cast<std::size_t>(parent)];
    }
    const HullFacet& facet = planes.facet(static_cast<std::uint32_t>(-1 - parent));
    return length_m + std::max(0.0, facet.offset_m - facet.normal.dot(at));
}

}  // namespace graspd::concavity_detail
