#include "graspd/concavity/tetrahedral_concavity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fast_marching.hpp"
#include "fill_gap.hpp"
#include "gap_points.hpp"
#include "graspd/base/settings.hpp"
#include "graspd/base/stop.hpp"
#include "split_surface.hpp"
#include "work_limits.hpp"

namespace graspd {
namespace {

using namespace concavity_detail;
using Eigen::Vector3d;

// Edges of the surface that are longer, in cells, are split before any tetrahedron is made: points
// half a cell off the surface would break them anyhow, in more rounds.
constexpr double kLongestEdge = 1.5;
constexpr double kOnHull = 1e-9;  // [1] of the diagonal: rounding of coordinates on a hull facet

/// Coordinates about the middle of the hull, in diagonals: sizes near 1 keep CGAL's filters cheap.
struct UnitFrame {
    Vector3d middle_m;
    double diagonal_m;

    Vector3d to_unit(const Vector3d& p) const { return (p - middle_m) / diagonal_m; }
    Vector3d to_metres(const Vector3d& p) const { return middle_m + diagonal_m * p; }
};

UnitFrame unit_frame(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.faces) {
        for (const std::uint32_t v : t) box.extend(mesh.vertices[v]);
    }
    return {box.center(), box.diagonal().norm()};
}

/// A mesh without its unreferenced vertices, and which vertex each kept one was.
struct UsedMesh {
    TriangleMesh mesh;
    std::vector<std::uint32_t> vertex;  ///< rising, of the mesh as given
};

UsedMesh used_part(const TriangleMesh& mesh) {
    constexpr std::uint32_t kUnused = UINT32_MAX;
    std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
    for (const Triangle& t : mesh.faces) {
        for (const std::uint32_t v : t) place[v] = 0;
    }
    UsedMesh used;
    for (std::uint32_t v = 0; v < place.size(); ++v) {
        if (place[v] == kUnused) continue;
        place[v] = static_cast<std::uint32_t>(used.vertex.size());
        used.vertex.push_back(v);
        used.mesh.vertices.push_back(mesh.vertices[v]);
    }
    for (const Triangle& t : mesh.faces) {
        used.mesh.faces.push_back({place[t[0]], place[t[1]], place[t[2]]});
    }
    return used;
}

/// The gap between the mesh and its hull in the unit frame; the mesh's vertices come first.
Result<Gap> tetrahedralize(const UsedMesh& used, const UnitFrame& frame,
                           const std::vector<Vector3d>& extra_m, const WorkLimits& limits) {
    std::vector<Vector3d> points;
    for (const Vector3d& p : used.mesh.vertices) points.push_back(frame.to_unit(p));
    for (const Vector3d& p : extra_m) points.push_back(frame.to_unit(p));
    SplitSurface surface(used.mesh.faces);
    const auto& config = limits.config();
    if (!surface.split_long_edges(kLongestEdge * config.cell_size, config.max_cells, points)) {
        return *limits.exceeded(surface.pieces().size());
    }
    return fill_gap(std::move(surface), std::move(points), limits);
}

/// Points of the space that lie on the hull, and its edges that join two such through the inside,
/// from one facet to another.
FrontSources sources_on(const OuterHull& hull, const Tetrahedra& space, const UnitFrame& frame) {
    const HullPlaneTree planes(hull);
    const auto is_on_hull = [&](const Vector3d& p) {
        return planes.nearest(frame.to_metres(p)).distance_m <= kOnHull * frame.diagonal_m;
    };
    FrontSources sources;
    for (const Vector3d& p : space.points) {
        stop_point(sources.is_source.size());
        sources.is_source.push_back(is_on_hull(p));
    }
    std::size_t step = 0;
    for (const auto& cell : space.cells) {
        stop_point(step++);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = i + 1; k < 4; ++k) {
                const std::uint32_t a = cell[i], b = cell[k];
                if (!sources.is_source[a] || !sources.is_source[b]) continue;
                if (is_on_hull(0.5 * (space.points[a] + space.points[b]))) continue;
                sources.chords.insert(edge_key(a, b));
            }
        }
    }
    return sources;
}

/// All vertices unreferenced: no value, no way.
ConcavityField empty_field(std::size_t vertices) {
    ConcavityField field;
    field.value_m.assign(vertices, std::numeric_limits<double>::quiet_NaN());
    field.flag.assign(vertices, ConcavityFlag::kUnreferenced);
    field.parent.assign(vertices, ConcavityField::kNoParent);
    return field;
}

}  // namespace

Result<ConcavityField> tetrahedral_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                             const TriangleBvh& bvh,
                                             const TetrahedralConfig& config) {
    if (auto bad = validate(config, "tetrahedral_concavity.")) return *std::move(bad);
    if (mesh.faces.empty() || hull.facets.empty()) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "concavity needs a mesh with faces and its hull, got " +
                             std::to_string(mesh.faces.size()) + " faces and " +
                             std::to_string(hull.facets.size()) + " hull facets"};
    }
    const WorkLimits limits(config);
    const UnitFrame frame = unit_frame(mesh);
    const auto extra = gap_points(mesh, hull, bvh, config.cell_size * frame.diagonal_m, limits);
    if (!extra) return extra.error();
    const UsedMesh used = used_part(mesh);
    const auto gap = tetrahedralize(used, frame, extra.value(), limits);
    if (!gap) return gap.error();
    const Tetrahedra& space = gap.value().space;
    const auto unit = march_front(space, sources_on(hull, space, frame));

    ConcavityField field = empty_field(mesh.vertices.size());
    for (std::size_t i = 0; i < used.vertex.size(); ++i) {
        const double value_m = frame.diagonal_m * unit[gap.value().node_of_point[i]];
        const bool is_reached = std::isfinite(value_m);
        field.value_m[used.vertex[i]] = value_m;
        field.flag[used.vertex[i]] = is_reached ? ConcavityFlag::kPath : ConcavityFlag::kEnclosed;
        if (is_reached) field.largest_m = std::max(field.largest_m, value_m);
    }
    return field;
}

}  // namespace graspd
