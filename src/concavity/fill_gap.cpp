#include "fill_gap.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include "graspd/base/stop.hpp"

namespace graspd::concavity_detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

struct Number {
    static constexpr std::uint32_t kNone = UINT32_MAX;
    std::uint32_t value = kNone;
};
struct Walls {
    std::array<bool, 4> is_wall{};  ///< facet opposite corner k is a piece of the surface
    std::array<int, 4> front{};     ///< pieces that show this cell their front less their back
    bool is_outside = false;
};
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<Number, Kernel>,
                CGAL::Triangulation_cell_base_with_info_3<
                    Walls, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;
using Vertex = Triangulation::Vertex_handle;
using Cell = Triangulation::Cell_handle;
using Facet = Triangulation::Facet;

// More missing pieces than so many times the least so far, and some: where a mesh intersects itself
// their number doubles every round. On fit meshes it falls, with rises by less than three, or a few
// go round a ring, each mended piece displacing the next.
constexpr std::size_t kMostGrowth = 3;
constexpr std::size_t kMostGrown = 100;
constexpr std::size_t kPointsBetweenChecks = 4096;  // about 20 ms

template <class... Parts>
PlanError error(PlanErrorCode code, const Parts&... parts) {
    std::ostringstream text;
    text << "tetrahedral concavity: ";
    (text << ... << parts);
    return PlanError{code, text.str()};
}

class GapFiller {
public:
    GapFiller(SplitSurface surface, std::vector<Eigen::Vector3d> points, const WorkLimits& limits)
        : surface_(std::move(surface)), points_(std::move(points)), limits_(limits) {}

    std::optional<PlanError> insert_points();
    std::optional<PlanError> make_conforming();
    std::optional<PlanError> find_outside();
    Gap take() const;

private:
    std::optional<Facet> facet_of(const Triangle& piece) const;
    std::vector<std::size_t> missing_pieces() const;
    std::vector<std::size_t> adopt_flat_pieces();
    bool is_before(const Triangle& piece, const Facet& facet) const;
    void raise_walls();
    void flood();

    SplitSurface surface_;
    std::vector<Eigen::Vector3d> points_;
    const WorkLimits& limits_;
    Triangulation triangulation_;
    std::vector<Vertex> vertex_;  ///< of each point
};

/// Inserts the points that are not in yet, neighbours after each other.
std::optional<PlanError> GapFiller::insert_points() {
    std::vector<Point> places;
    for (std::size_t i = vertex_.size(); i < points_.size(); ++i) {
        places.emplace_back(points_[i].x(), points_[i].y(), points_[i].z());
    }
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto place_of = CGAL::make_property_map(places);
    CGAL::spatial_sort(order.begin(), order.end(),
                       CGAL::Spatial_sort_traits_adapter_3<Kernel, decltype(place_of)>(place_of));
    const std::size_t first = vertex_.size();
    vertex_.resize(points_.size());
    Cell hint;
    for (std::size_t done = 0; done < order.size(); ++done) {
        if (done % kPointsBetweenChecks == 0) {
            if (auto error = limits_.exceeded(triangulation_.number_of_cells())) return error;
        }
        const std::size_t i = order[done];
        const Vertex vertex = triangulation_.insert(places[i], hint);
        auto& number = vertex->info().value;
        if (number == Number::kNone) number = static_cast<std::uint32_t>(first + i);
        vertex_[first + i] = vertex;
        hint = vertex->cell();
    }
    return limits_.exceeded(triangulation_.number_of_finite_cells());
}

std::optional<Facet> GapFiller::facet_of(const Triangle& piece) const {
    Cell cell;
    int i = 0, j = 0, k = 0;
    const bool is_there = triangulation_.is_facet(vertex_[piece[0]], vertex_[piece[1]],
                                                  vertex_[piece[2]], cell, i, j, k);
    return is_there ? std::optional(Facet(cell, 6 - i - j - k)) : std::nullopt;
}

/// Pieces that are no faces of tetrahedra.
std::vector<std::size_t> GapFiller::missing_pieces() const {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < surface_.pieces().size(); ++i) {
        stop_point(i);
        if (!facet_of(surface_.pieces()[i])) missing.push_back(i);
    }
    return missing;
}

/// In a flat part of the surface any cut into pieces will do: takes the triangulation's own.
/// Every turn makes one missing edge less, so this ends.
std::vector<std::size_t> GapFiller::adopt_flat_pieces() {
    const auto has_edge = [&](std::uint32_t a, std::uint32_t b) {
        Cell cell;
        int i = 0, j = 0;
        return triangulation_.is_edge(vertex_[a], vertex_[b], cell, i, j);
    };
    std::vector<std::size_t> missing = missing_pieces();
    while (surface_.flip_flat(missing, has_edge, points_) > 0) missing = missing_pieces();
    return missing;
}

/// Splits missing pieces at their longest edge, be that there or not: it keeps the pieces' angles,
/// while splitting the edges that are missing makes needles without end.
std::optional<PlanError> GapFiller::make_conforming() {
    std::size_t least = SIZE_MAX;
    for (std::uint32_t round = 0;; ++round) {
        const std::vector<std::size_t> pieces = adopt_flat_pieces();
        const std::size_t missing = pieces.size();
        if (missing == 0) return std::nullopt;
        least = std::min(least, missing);
        const bool is_stuck = missing > kMostGrowth * least + kMostGrown;
        if (is_stuck || round >= limits_.config().max_split_rounds) {
            return error(PlanErrorCode::kDegenerate, missing, " of ", surface_.pieces().size(),
                         " pieces of the surface are no faces of tetrahedra after ", round,
                         " rounds of splitting (max_split_rounds = ",
                         limits_.config().max_split_rounds, is_stuck ? ", no longer fewer" : "",
                         "): the mesh intersects itself, or has very thin parts or angles");
        }
        for (const std::size_t i : pieces) surface_.mark_longest(surface_.pieces()[i], points_);
        surface_.split(points_);
        if (auto limit = insert_points()) return limit;
    }
}

/// Whether a cell lies before a piece of the surface that is its facet, as the piece is wound.
bool GapFiller::is_before(const Triangle& piece, const Facet& facet) const {
    const Vertex opposite = facet.first->vertex(facet.second);
    if (triangulation_.is_infinite(opposite)) {
        return !is_before(piece, triangulation_.mirror_facet(facet));
    }
    return CGAL::orientation(vertex_[piece[0]]->point(), vertex_[piece[1]]->point(),
                             vertex_[piece[2]]->point(), opposite->point()) == CGAL::POSITIVE;
}

/// Makes every piece a wall on both its sides.
void GapFiller::raise_walls() {
    std::size_t step = 0;
    for (const Triangle& piece : surface_.pieces()) {
        stop_point(step++);
        const Facet facet = facet_of(piece).value();  // make_conforming() saw to it
        for (const Facet& side : {facet, triangulation_.mirror_facet(facet)}) {
            const auto k = static_cast<std::size_t>(side.second);
            side.first->info().is_wall[k] = true;
            side.first->info().front[k] += is_before(piece, side) ? 1 : -1;
        }
    }
}

/// Goes from the infinite cells through every facet that is no wall.
void GapFiller::flood() {
    std::vector<Cell> stack;
    for (const Cell cell : triangulation_.all_cell_handles()) {
        if (!triangulation_.is_infinite(cell)) continue;
        cell->info().is_outside = true;
        stack.push_back(cell);
    }
    std::size_t step = 0;
    while (!stack.empty()) {
        stop_point(step++);
        const Cell cell = stack.back();
        stack.pop_back();
        for (int k = 0; k < 4; ++k) {
            const Cell next = cell->neighbor(k);
            if (cell->info().is_wall[static_cast<std::size_t>(k)] || next->info().is_outside) {
                continue;
            }
            next->info().is_outside = true;
            stack.push_back(next);
        }
    }
}

/// A fold of no thickness shows a front and a back on the same side: that is no leak.
std::optional<PlanError> GapFiller::find_outside() {
    raise_walls();
    flood();
    std::size_t leaks = 0;
    for (const Cell cell : triangulation_.all_cell_handles()) {
        if (!cell->info().is_outside) continue;
        leaks += static_cast<std::size_t>(
            std::ranges::count_if(cell->info().front, [](int front) { return front < 0; }));
    }
    if (leaks == 0) return std::nullopt;
    return error(PlanErrorCode::kInvalidInput, leaks, " of ", surface_.pieces().size(),
                 " pieces of the surface are reached from behind: the mesh is open or inside out");
}

Gap GapFiller::take() const {
    Gap gap;
    gap.space.points = points_;
    for (const Cell cell : triangulation_.finite_cell_handles()) {
        if (!cell->info().is_outside) continue;
        auto& corners = gap.space.cells.emplace_back();
        for (int k = 0; k < 4; ++k) {
            corners[static_cast<std::size_t>(k)] = cell->vertex(k)->info().value;
        }
    }
    for (const Vertex vertex : vertex_) gap.node_of_point.push_back(vertex->info().value);
    return gap;
}

}  // namespace

Result<Gap> fill_gap(SplitSurface surface, std::vector<Eigen::Vector3d> points,
                     const WorkLimits& limits) {
    try {
        GapFiller filler(std::move(surface), std::move(points), limits);
        if (auto error = filler.insert_points()) return *std::move(error);
        if (auto error = filler.make_conforming()) return *std::move(error);
        if (auto error = filler.find_outside()) return *std::move(error);
        return filler.take();
    } catch (const std::exception& failure) {
        return error(PlanErrorCode::kInternal, "CGAL failed: ", failure.what());
    }
}

}  // namespace graspd::concavity_detail
