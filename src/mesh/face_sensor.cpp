#include "graspd/mesh/face_sensor.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "graspd/base/settings.hpp"
#include "solid_properties.hpp"

namespace graspd {
namespace {

/// What the cloud's own triangles make of the closed surface.
struct SeenSide {
    TriangleMesh mesh;                                         ///< without the fills
    Eigen::Vector3d area_vector_m2 = Eigen::Vector3d::Zero();  ///< sum of area x outward normal
    double area_m2 = 0.0;
    double facing_m2 = 0.0;  ///< that looks to the sensor
};

SeenSide seen_side(const ConditionedMesh& closed, const Eigen::Vector3d& sensor) {
    SeenSide seen;
    const std::size_t kept = closed.mesh.vertices.size() - closed.fill_vertices;
    seen.mesh.vertices.assign(closed.mesh.vertices.begin(),
                              closed.mesh.vertices.begin() + static_cast<std::ptrdiff_t>(kept));
    for (const Triangle& t : closed.mesh.faces) {
        if (std::ranges::any_of(t, [&](std::uint32_t v) { return v >= kept; })) continue;
        seen.mesh.faces.push_back(t);
        const Eigen::Vector3d& a = closed.mesh.vertices[t[0]];
        const Eigen::Vector3d half =
            0.5 * (closed.mesh.vertices[t[1]] - a).cross(closed.mesh.vertices[t[2]] - a);
        seen.area_vector_m2 += half;
        seen.area_m2 += half.norm();
        if (half.dot(sensor - a) > 0.0) seen.facing_m2 += half.norm();
    }
    return seen;
}

/// The surface turned over, a copy of it farther from the sensor, and a rim that joins them.
TriangleMesh shell_behind(const TriangleMesh& seen, const Eigen::Vector3d& sensor,
                          double thickness_m) {
    TriangleMesh shell = seen;
    const auto count = static_cast<std::uint32_t>(seen.vertices.size());
    for (const Eigen::Vector3d& vertex : seen.vertices) {
        shell.vertices.push_back(vertex + thickness_m * (vertex - sensor).stableNormalized());
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> halves;
    for (Triangle& t : shell.faces) {
        std::swap(t[1], t[2]);
        for (std::size_t k = 0; k < 3; ++k) halves.insert({t[k], t[(k + 1) % 3]});
    }
    for (const Triangle& t : seen.faces) {
        shell.faces.push_back({t[0] + count, t[1] + count, t[2] + count});
    }
    for (const auto& [from, to] : halves) {
        if (halves.contains({to, from})) continue;
        shell.faces.push_back({to, from, from + count});
        shell.faces.push_back({to, from + count, to + count});
    }
    return shell;
}

/// Where the vertices of an input of an input went.
std::vector<std::int32_t> chained(std::vector<std::int32_t> first,
                                  const std::vector<std::int32_t>& second) {
    for (std::int32_t& vertex : first) {
        if (vertex >= 0) vertex = second[static_cast<std::size_t>(vertex)];
    }
    return first;
}

double diagonal_m(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
    return box.diagonal().norm();
}

Finding one_sided(double seen_m2, double all_m2, const std::string& what) {
    std::ostringstream text;
    text << 100.0 * seen_m2 / all_m2 << " % of the surface that is planned on was seen, from one "
         << "side; " << what;
    return {"one_sided", seen_m2 / all_m2, text.str()};
}

}  // namespace

Result<ConditionedMesh> face_sensor(ConditionedMesh closed,
                                    const std::optional<Eigen::Vector3d>& sensor_origin,
                                    const ConditionMeshConfig& condition,
                                    const FaceSensorConfig& config) {
    if (auto bad = validate(config, "face_sensor.")) return *bad;
    if (closed.alpha_wrapped) return closed;
    const Eigen::Vector3d sensor = sensor_origin.value_or(Eigen::Vector3d::Zero());
    const SeenSide seen = seen_side(closed, sensor);
    if (seen.area_vector_m2.norm() < config.one_sided_from * seen.area_m2) return closed;
    const bool hollow = sensor_origin && seen.facing_m2 < 0.5 * seen.area_m2;
    if (!hollow) {
        closed.findings.push_back(one_sided(
            seen.area_m2, mesh_detail::surface_area_m2(closed.mesh),
            sensor_origin ? "the rest is closed over its rim, behind it"
                          : "without a sensor origin it is taken to bulge towards the sensor"));
        return closed;
    }
    const double thickness_m = config.back_thickness * diagonal_m(seen.mesh);
    auto shell = condition_mesh(shell_behind(seen.mesh, sensor, thickness_m), condition);
    if (!shell) return shell.error();
    ConditionedMesh& result = shell.value();
    result.vertex_of_input = chained(std::move(closed.vertex_of_input), result.vertex_of_input);
    std::vector<Finding> findings = std::move(closed.findings);
    // The first closing is undone, its repairs of faces stand.
    std::erase_if(findings, [](const Finding& f) {
        return f.code == "holes_filled" || f.code == "components" || f.code == "floating_parts";
    });
    std::ostringstream what;
    what << "it is hollow towards the sensor: a shell of " << thickness_m
         << " m behind it stands for the rest";
    findings.push_back(
        one_sided(seen.area_m2, mesh_detail::surface_area_m2(result.mesh), what.str()));
    result.findings.insert(result.findings.begin(), findings.begin(), findings.end());
    return shell;
}

}  // namespace graspd
