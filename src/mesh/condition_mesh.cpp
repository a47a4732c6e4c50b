#include "graspd/mesh/condition_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "alpha_wrap.hpp"
#include "clean_faces.hpp"
#include "fill_holes.hpp"
#include "floating_parts.hpp"
#include "graspd/base/settings.hpp"
#include "graspd/base/stop.hpp"
#include "mesh_edges.hpp"
#include "orient_faces.hpp"
#include "plan_error_text.hpp"
#include "solid_properties.hpp"

namespace graspd {
namespace {

using mesh_detail::error;

using namespace mesh_detail;

// Differences of doubles carry about 1e-16 of the largest coordinate; a tolerance below that can
// only mean equality.
constexpr double kLeastWeldTolerance = 1e-15;

// [1] Of the square root of the area: a seam between faces that cannot agree. A twisted strip three
// times as long as wide has 0.58; a shorter seam is a flaw in one place of a surface that has an
// outside everywhere else.
constexpr double kLeastSeam = 0.05;

std::optional<PlanError> check_counts(const TriangleMesh& soup, const ConditionMeshConfig& config) {
    if (soup.vertices.empty() || soup.faces.empty()) {
        return error(PlanErrorCode::kInvalidInput, "mesh is empty: ", soup.vertices.size(),
                     " vertices, ", soup.faces.size(), " faces");
    }
    if (soup.vertices.size() > config.max_vertices) {
        return error(PlanErrorCode::kTooLarge, "mesh has ", soup.vertices.size(),
                     " vertices, limit max_vertices = ", config.max_vertices);
    }
    if (soup.faces.size() > config.max_faces) {
        return error(PlanErrorCode::kTooLarge, "mesh has ", soup.faces.size(),
                     " faces, limit max_faces = ", config.max_faces);
    }
    return std::nullopt;
}

std::optional<PlanError> check_values(const TriangleMesh& soup) {
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
        stop_point(i);
        const Eigen::Vector3d& vertex = soup.vertices[i];
        if (vertex.allFinite()) continue;
        return error(PlanErrorCode::kInvalidInput, "mesh vertex ", i, " = (", vertex.x(), ", ",
                     vertex.y(), ", ", vertex.z(), ") is not finite");
    }
    std::uint32_t highest = 0;
    for (const Triangle& face : soup.faces) {
        for (const std::uint32_t vertex : face) highest = std::max(highest, vertex);
    }
    if (highest < soup.vertices.size()) return std::nullopt;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        for (const std::uint32_t vertex : soup.faces[f]) {
            if (vertex < soup.vertices.size()) continue;
            return error(PlanErrorCode::kInvalidInput, "mesh face ", f, " uses vertex ", vertex,
                         " of ", soup.vertices.size());
        }
    }
    return std::nullopt;
}

std::vector<char> vertices_in_use(const TriangleMesh& soup) {
    std::vector<char> in_use(soup.vertices.size(), 0);
    for (const Triangle& face : soup.faces) {
        for (const std::uint32_t vertex : face) in_use[vertex] = 1;
    }
    return in_use;
}

/// Diagonal of the box around the vertices in use [m].
double diagonal_of(const TriangleMesh& soup, const std::vector<char>& in_use) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < in_use.size(); ++i) {
        if (in_use[i]) box.extend(soup.vertices[i]);
    }
    return box.diagonal().norm();
}

/// The findings, in the order of the work.
class FindingList {
public:
    explicit FindingList(std::vector<Finding>& list) : list_(list) {}

    template <class... Parts>
    void add(const char* code, double value, const Parts&... parts) {
        if (value == 0.0) return;
        std::ostringstream text;
        text << value;
        (text << ... << parts);
        list_.push_back({code, value, text.str()});
    }

private:
    std::vector<Finding>& list_;
};

void report_cleaning(const CleanFaces& clean, FindingList& findings) {
    findings.add("vertices_welded", clean.welded, " vertices stood where an earlier one stands");
    findings.add("degenerate_faces_dropped", clean.degenerate, " faces had two equal corners");
    findings.add("duplicate_faces_dropped", clean.duplicate,
                 " faces had the corners of an earlier face");
    findings.add("vertices_unreferenced", clean.unreferenced, " vertices belong to no kept face");
}

/// A closed surface's solid, and what is left of the trouble with it.
struct ClosedSolid {
    SolidProperties solid;
    std::uint32_t fill_vertices = 0;  ///< that close its holes
    double seam_m = 0.0;  ///< [m] edges whose two faces are at odds however they are turned
};

/// Turns the faces that disagree with their patch, closes the holes, turns the surfaces outward.
ClosedSolid close_and_orient(TriangleMesh& mesh, const MeshEdges& edges, FindingList& findings) {
    stop_point();
    Orientation patches = orient_faces(mesh.faces, edges);
    stop_point();
    DisjointSets groups(patches.patches);
    const auto [open, seam_m] = find_open_edges(mesh, edges, patches, groups);
    if (patches.flipped > 0) turn_faces(patches.flip, mesh.faces);
    const auto loops = walk_loops(open, mesh.vertices.size());
    const HoleFill fill = fill_holes(open, loops, mesh, patches.patch_of_face, groups);
    stop_point();
    const OutwardSolid outward = turn_outward(mesh, patches.patch_of_face, patches.patches, groups);

    stop_point();
    findings.add("faces_flipped", patches.flipped, " faces were wound against their neighbours");
    if (!loops.empty()) {
        findings.add("holes_filled", static_cast<double>(loops.size()), " boundary loops closed, ",
                     open.size(), " edges, fill is ", 100.0 * fill.area_m2 / surface_area_m2(mesh),
                     " % of the area");
    }
    findings.add("components_inverted", outward.turned, " surfaces pointed inward");
    findings.add("non_manifold_edges", static_cast<double>(edges.crowded_edges),
                 " edges have more than two faces");
    const std::uint32_t components = count_components(mesh, patches.patch_of_face, patches.patches);
    findings.add("components", components,
                 components == 1 ? " piece" : " pieces without a common vertex");
    return {outward.solid, fill.vertices, seam_m};
}

double cube(double length) {
    return length * length * length;
}

std::optional<std::string> why_sheet(double volume_m3, double diagonal_m, double min_solidity) {
    const double ratio = volume_m3 / cube(diagonal_m);
    if (std::isfinite(ratio) && volume_m3 > 0.0 && ratio >= min_solidity) return std::nullopt;
    std::ostringstream text;
    text << "mesh is a flat sheet: volume " << volume_m3 << " m3 over its diagonal " << diagonal_m
         << " m cubed is " << ratio << ", least min_solidity = " << min_solidity;
    return text.str();
}

std::optional<std::string> why_one_sided(const ConditionedMesh& closed, double seam_m) {
    if (seam_m <= kLeastSeam * std::sqrt(surface_area_m2(closed.mesh))) return std::nullopt;
    std::ostringstream text;
    text << "mesh is one-sided: along " << seam_m
         << " m of edges its faces are at odds however they are turned";
    return text.str();
}

/// Replaces a closed mesh by the wrap around `open`, the input's faces without fills.
std::optional<PlanError> wrap_instead(const TriangleMesh& open, const std::string& reason,
                                      const ConditionMeshConfig& config, ConditionedMesh& result) {
    auto wrap = alpha_wrap(open, config.wrap_alpha, config.wrap_offset);
    if (!wrap.ok()) return error(wrap.error().code, reason, "; ", wrap.error().detail);
    result.mesh = std::move(wrap.value().mesh);
    result.alpha_wrapped = true;
    result.fill_vertices = 0;
    FindingList findings(result.findings);
    findings.add("alpha_wrapped", wrap.value().alpha_m, " m is the alpha of the wrap, ",
                 wrap.value().offset_m, " m off the faces, that stands for the mesh: ", reason);
    const MeshEdges edges = collect_edges(result.mesh.faces, result.mesh.vertices.size());
    const SolidProperties solid = close_and_orient(result.mesh, edges, findings).solid;
    result.volume_m3 = solid.volume_m3;
    result.center_of_mass = solid.center_of_mass;
    for (std::int32_t& vertex : result.vertex_of_input) {
        if (vertex >= 0) vertex = static_cast<std::int32_t>(wrap.value().nearest_of_vertex[vertex]);
    }
    return std::nullopt;
}

/// Closes the faces of `result.mesh`, or wraps them when that gives no outside.
std::optional<PlanError> close_or_wrap(const MeshEdges& edges, double diagonal_m,
                                       const ConditionMeshConfig& config, ConditionedMesh& result) {
    const std::size_t vertices = result.mesh.vertices.size(), faces = result.mesh.faces.size();
    const std::size_t cleaning = result.findings.size();
    FindingList findings(result.findings);
    const ClosedSolid closed = close_and_orient(result.mesh, edges, findings);
    result.fill_vertices = closed.fill_vertices;
    result.volume_m3 = closed.solid.volume_m3;
    result.center_of_mass = closed.solid.center_of_mass;
    const bool wrap = config.alpha_wrap && std::isnormal(cube(diagonal_m));
    auto reason = why_sheet(result.volume_m3, diagonal_m, config.min_solidity);
    if (reason && !wrap) return error(PlanErrorCode::kDegenerate, *reason);
    if (wrap && closed.seam_m > 0.0) {
        if (auto one_sided = why_one_sided(result, closed.seam_m)) reason = std::move(one_sided);
    }
    if (!reason) return std::nullopt;
    TriangleMesh open = std::move(result.mesh);  // fills stand at the end
    open.vertices.resize(vertices);
    open.faces.resize(faces);
    result.findings.resize(cleaning);  // what the closing did is undone
    if (auto bad = wrap_instead(open, *reason, config, result)) return bad;
    if (auto still = why_sheet(result.volume_m3, diagonal_m, config.min_solidity)) {
        return error(PlanErrorCode::kDegenerate, *reason, "; its wrap too: ", *still);
    }
    return std::nullopt;
}

}  // namespace

Result<ConditionedMesh> condition_mesh(const TriangleMesh& soup,
                                       const ConditionMeshConfig& config) {
    if (auto bad = validate(config, "condition_mesh.")) return *bad;
    if (auto bad = check_counts(soup, config)) return *bad;
    if (auto bad = check_values(soup)) return *bad;
    stop_point();
    const std::vector<char> in_use = vertices_in_use(soup);
    stop_point();
    const double diagonal_m = diagonal_of(soup, in_use);
    if (!std::isfinite(diagonal_m)) {
        return error(PlanErrorCode::kInvalidInput, "mesh extent ", diagonal_m,
                     " m: its bounding box is too large to measure");
    }
    stop_point();
    const bool exact = config.weld_tolerance < kLeastWeldTolerance;
    CleanFaces clean = clean_faces(soup, in_use, exact ? 0.0 : config.weld_tolerance * diagonal_m);
    if (clean.mesh.faces.empty()) {
        return error(PlanErrorCode::kDegenerate, "all ", soup.faces.size(),
                     " faces of the mesh are degenerate (two equal corners)");
    }
    ConditionedMesh result;
    FindingList findings(result.findings);
    report_cleaning(clean, findings);
    result.mesh = std::move(clean.mesh);
    result.vertex_of_input = std::move(clean.vertex_of_input);
    if (auto bad = close_or_wrap(clean.edges, diagonal_m, config, result)) return *bad;
    const auto pieces = std::ranges::find(result.findings, "components", &Finding::code);
    if (pieces->value > 1.0) {
        if (auto apart = find_floating_parts(result.mesh)) result.findings.push_back(*apart);
    }
    return result;
}

}  // namespace graspd
