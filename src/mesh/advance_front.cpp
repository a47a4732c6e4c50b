#include <array>
#include <cstddef>
#include <exception>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "cloud_surface.hpp"
#include "graspd/base/stop.hpp"

namespace graspd::mesh_detail {
namespace {

// CGAL breaks ties of its front, of which a regular cloud has many, by addresses, so that the
// same cloud can give two surfaces. The cells and vertices below order themselves by number.

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A cell that is compared by its age.
template <class Base = CGAL::Delaunay_triangulation_cell_base_3<Kernel>>
class AgedCell : public CGAL::Advancing_front_surface_reconstruction_cell_base_3<Kernel, Base> {
    using Parent = CGAL::Advancing_front_surface_reconstruction_cell_base_3<Kernel, Base>;

public:
    template <class Tds>
    struct Rebind_TDS {  // NOLINT(readability-identifier-naming): CGAL's
        using Other = AgedCell<typename Base::template Rebind_TDS<Tds>::Other>;
    };
    using Parent::Parent;

    using Has_timestamp = CGAL::Tag_true;  // NOLINT(readability-identifier-naming)
    std::size_t time_stamp() const { return age_; }
    void set_time_stamp(std::size_t age) { age_ = age; }

private:
    std::size_t age_ = static_cast<std::size_t>(-1);
};

/// A vertex whose entries in the front are ordered by value, then by the ends of their edge.
template <class Base = CGAL::Triangulation_vertex_base_3<Kernel>>
class NumberedVertex
    : public CGAL::Advancing_front_surface_reconstruction_vertex_base_3<Kernel, Base> {
    using Parent = CGAL::Advancing_front_surface_reconstruction_vertex_base_3<Kernel, Base>;

public:
    template <class Tds>
    struct Rebind_TDS {  // NOLINT(readability-identifier-naming): CGAL's
        using Other = NumberedVertex<typename Base::template Rebind_TDS<Tds>::Other>;
    };
    using Parent::Parent;

    class FrontEntry {
    public:
        using Edge = typename Parent::IO_edge_type;

        FrontEntry(double value, Edge* edge) : first(value), second(edge) {
            const auto& [cell, from, to] = edge->first.first;
            stop_point();  // CGAL has no place for it, but asks for an entry again and again
            ends_ = std::minmax({cell->vertex(from)->id(), cell->vertex(to)->id()});
        }
        bool operator<(const FrontEntry& other) const {
            if (first != other.first) return first < other.first;
            if (ends_ != other.ends_) return ends_ < other.ends_;
            return std::less<>()(second, other.second);  // the same edge twice: never seen
        }

        double first;  // CGAL calls them so
        Edge* second;

    private:
        std::pair<std::size_t, std::size_t> ends_;
    };
    using Radius_ptr_type = FrontEntry;  // NOLINT(readability-identifier-naming)
};

using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<NumberedVertex<>, AgedCell<>>>;
using Reconstruction = CGAL::Advancing_front_surface_reconstruction<Triangulation>;

std::vector<std::array<std::size_t, 3>> reconstruct(const std::vector<Eigen::Vector3d>& points) {
    std::vector<std::pair<Kernel::Point_3, std::size_t>> numbered;
    numbered.reserve(points.size());
    for (const Eigen::Vector3d& p : points) {
        numbered.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), numbered.size());
    }
    Triangulation triangulation(numbered.begin(), numbered.end());
    Reconstruction reconstruction(triangulation);
    reconstruction.run();
    std::vector<std::array<std::size_t, 3>> facets;
    CGAL::write_triple_indices(std::back_inserter(facets), reconstruction);
    return facets;
}

}  // namespace

Result<std::vector<Triangle>> advance_front(const std::vector<Eigen::Vector3d>& points) {
    try {
        std::vector<Triangle> triangles;
        for (const auto& facet : reconstruct(points)) {
            triangles.push_back({static_cast<std::uint32_t>(facet[0]),
                                 static_cast<std::uint32_t>(facet[1]),
                                 static_cast<std::uint32_t>(facet[2])});
        }
        return triangles;
    } catch (const std::exception& error) {
        return PlanError{PlanErrorCode::kInternal,
                         std::string("triangulate_cloud: CGAL failed: ") + error.what()};
    }
}

}  // namespace graspd::mesh_detail
