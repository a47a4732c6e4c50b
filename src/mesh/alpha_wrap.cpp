#include "alpha_wrap.hpp"

#include <exception>
#include <string>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_incremental_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/property_map.h>

#include "graspd/base/stop.hpp"

namespace graspd::mesh_detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Asks at every facet of the wrap under way.
struct StoppableWrap : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
    template <class Wrapper, class Gate>
    void before_facet_treatment(const Wrapper& /*wrapper*/, const Gate& /*gate*/) {
        stop_point();
    }
};

/// Takes the box around a soup to one of diagonal 1 about the origin, so that the wrap does not
/// depend on the unit, and no digits are lost far from the origin.
struct UnitFrame {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double diagonal_m = 0.0;

    explicit UnitFrame(const std::vector<Eigen::Vector3d>& vertices) {
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
        middle = box.center();
        diagonal_m = box.diagonal().norm();
    }
    Eigen::Vector3d to_unit(const Eigen::Vector3d& vertex) const {
        return (vertex - middle) / diagonal_m;
    }
    Eigen::Vector3d to_metres(const Eigen::Vector3d& p) const { return middle + diagonal_m * p; }
};

Kernel::Point_3 to_point(const Eigen::Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

bool has_area(const TriangleMesh& mesh, const Triangle& face) {
    const Eigen::Vector3d& a = mesh.vertices[face[0]];
    return (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a).squaredNorm() > 0.0;
}

/// Per vertex the sum of its faces' area vectors; zero where they cancel.
std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
    std::vector<Eigen::Vector3d> normal(mesh.vertices.size(), Eigen::Vector3d::Zero());
    for (const Triangle& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.vertices[face[0]];
        const Eigen::Vector3d twice_area =
            (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a);
        for (const std::uint32_t vertex : face) normal[vertex] += twice_area;
    }
    return normal;
}

TriangleMesh to_mesh(const Surface& surface) {
    TriangleMesh mesh;
    for (const auto vertex : surface.vertices()) {
        const Kernel::Point_3& p = surface.point(vertex);
        mesh.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto face : surface.faces()) {
        Triangle corners{};
        std::size_t k = 0;
        for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
            corners[k++] = static_cast<std::uint32_t>(vertex);
        }
        mesh.faces.push_back(corners);
    }
    return mesh;
}

/// For each vertex of `mesh` the nearest one of `surface` that looks to the same side. When none of
/// the nearest does, or the vertex has no side, simply the nearest.
std::vector<std::uint32_t> nearest_vertices(const TriangleMesh& mesh, const TriangleMesh& surface) {
    using Numbered = std::pair<Kernel::Point_3, std::uint32_t>;
    using Traits = CGAL::Search_traits_adapter<Numbered, CGAL::First_of_pair_property_map<Numbered>,
                                               CGAL::Search_traits_3<Kernel>>;
    using Search = CGAL::Orthogonal_incremental_neighbor_search<Traits>;
    constexpr int kLooks = 32;  // a sheet's two sides lie closer together than neighbours on one
    Search::Tree tree;
    for (std::uint32_t i = 0; i < surface.vertices.size(); ++i) {
        tree.insert({to_point(surface.vertices[i]), i});
    }
    const std::vector<Eigen::Vector3d> looks = vertex_normals(mesh);
    const std::vector<Eigen::Vector3d> surface_looks = vertex_normals(surface);
    std::vector<std::uint32_t> nearest;
    nearest.reserve(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        stop_point(v);
        const Search search(tree, to_point(mesh.vertices[v]));
        auto candidate = search.begin();
        nearest.push_back(candidate->first.second);
        for (int k = 0; k < kLooks && candidate != search.end(); ++k, ++candidate) {
            if (looks[v].dot(surface_looks[candidate->first.second]) <= 0.0) continue;
            nearest.back() = candidate->first.second;
            break;
        }
    }
    return nearest;
}

Result<AlphaWrap> wrap(const TriangleMesh& soup, double alpha, double offset) {
    const UnitFrame frame(soup.vertices);
    TriangleMesh unit;
    std::vector<Kernel::Point_3> points;
    for (const Eigen::Vector3d& vertex : soup.vertices) {
        unit.vertices.push_back(frame.to_unit(vertex));
        points.push_back(to_point(unit.vertices.back()));
    }
    for (const Triangle& face : soup.faces) {
        if (has_area(unit, face)) unit.faces.push_back(face);
    }
    if (unit.faces.empty()) {
        return PlanError{PlanErrorCode::kDegenerate, "no face of the mesh has an area"};
    }
    Surface surface;
    StoppableWrap stoppable;
    stop_point();
    CGAL::alpha_wrap_3(points, unit.faces, alpha, offset, surface,
                       CGAL::parameters::default_values(), CGAL::parameters::visitor(stoppable));
    if (surface.number_of_faces() == 0) {
        return PlanError{PlanErrorCode::kDegenerate, "the alpha wrap of the mesh is empty"};
    }
    AlphaWrap result;
    result.mesh = to_mesh(surface);
    result.nearest_of_vertex = nearest_vertices(unit, result.mesh);
    for (Eigen::Vector3d& vertex : result.mesh.vertices) vertex = frame.to_metres(vertex);
    result.alpha_m = alpha * frame.diagonal_m;
    result.offset_m = offset * frame.diagonal_m;
    return result;
}

}  // namespace

Result<AlphaWrap> alpha_wrap(const TriangleMesh& soup, double alpha, double offset) {
    try {
        return wrap(soup, alpha, offset);
    } catch (const std::exception& problem) {
        return PlanError{PlanErrorCode::kDegenerate,
                         std::string("CGAL could not wrap the mesh: ") + problem.what()};
    }
}

}  // namespace graspd::mesh_detail
