#include "diagnose_object.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>

#include "close_object.hpp"
#include "doctor_advice.hpp"
#include "graspd/base/disjoint_sets.hpp"
#include "graspd/mesh/principal_frame.hpp"
#include "graspd/mesh/self_intersections.hpp"

namespace graspd::cli {
namespace {

const Finding* find(const std::vector<Finding>& findings, const char* code) {
    const auto found = std::ranges::find(findings, code, &Finding::code);
    return found == findings.end() ? nullptr : &*found;
}

std::uint64_t count_of(const std::vector<Finding>& findings, const char* code) {
    const Finding* found = find(findings, code);
    return found ? static_cast<std::uint64_t>(found->value) : 0;
}

Eigen::Vector3d size_of(const std::vector<Eigen::Vector3d>& points) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) {
        if (point.allFinite()) box.extend(point);
    }
    return box.isEmpty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(box.sizes());
}

/// Pieces of the faces; corners at the same place are one, as a mesh without indices needs it.
std::uint64_t count_pieces(const TriangleMesh& mesh) {
    std::map<std::tuple<double, double, double>, std::uint32_t> place;
    std::vector<std::uint32_t> at(mesh.vertices.size(), 0);
    std::vector<char> in_use(mesh.vertices.size(), 0);
    DisjointSets sets(mesh.vertices.size());
    for (std::uint32_t v = 0; v < at.size(); ++v) {
        const Eigen::Vector3d& p = mesh.vertices[v];
        at[v] = p.allFinite() ? place.try_emplace({p.x(), p.y(), p.z()}, v).first->second : v;
    }
    for (const Triangle& t : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            in_use[at[t[k]]] = 1;
            sets.unite(at[t[k]], at[t[(k + 1) % 3]]);
        }
    }
    std::uint64_t pieces = 0;
    for (std::uint32_t v = 0; v < at.size(); ++v) pieces += in_use[v] && sets.find(v) == v;
    return pieces;
}

/// Area and, by the divergence theorem, the volume that the faces enclose if they are closed.
std::pair<double, double> area_and_volume(const TriangleMesh& mesh) {
    double area_m2 = 0.0, volume_m3 = 0.0;
    const Eigen::Vector3d origin =
        mesh.vertices.empty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : mesh.vertices.front();
    for (const Triangle& t : mesh.faces) {
        const Eigen::Vector3d a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin,
                              c = mesh.vertices[t[2]] - origin;
        area_m2 += 0.5 * (b - a).cross(c - a).norm();
        volume_m3 += a.dot(b.cross(c)) / 6.0;
    }
    return {area_m2, volume_m3};
}

ObjectFigures figures_as_stored(const std::variant<TriangleMesh, PointCloud>& object) {
    ObjectFigures figures;
    if (const auto* cloud = std::get_if<PointCloud>(&object)) {
        figures.vertices = cloud->points.size();
        figures.size_m = size_of(cloud->points);
        return figures;
    }
    const auto& mesh = std::get<TriangleMesh>(object);
    figures.vertices = mesh.vertices.size();
    figures.faces = mesh.faces.size();
    figures.components = count_pieces(mesh);
    figures.size_m = size_of(mesh.vertices);
    const auto [area_m2, volume_m3] = area_and_volume(mesh);
    figures.area_m2 = area_m2;
    figures.volume_m3 = volume_m3;
    return figures;
}

ObjectFigures figures_of(const ConditionedMesh& solid) {
    ObjectFigures figures;
    figures.vertices = solid.mesh.vertices.size();
    figures.faces = solid.mesh.faces.size();
    figures.components = count_of(solid.findings, "components");
    figures.size_m = size_of(solid.mesh.vertices);
    figures.area_m2 = area_and_volume(solid.mesh).first;
    figures.volume_m3 = solid.volume_m3;
    return figures;
}

/// Faces of the object itself that cross each other; fills are left out.
std::optional<Finding> crossing_faces(const ConditionedMesh& solid) {
    TriangleMesh own = solid.mesh;
    const std::size_t kept = own.vertices.size() - solid.fill_vertices;
    std::erase_if(own.faces, [&](const Triangle& t) {
        return std::ranges::any_of(t, [&](std::uint32_t v) { return v >= kept; });
    });
    const auto counted = count_self_intersections(own);
    if (counted && counted->pairs == 0) return std::nullopt;
    std::ostringstream text;
    if (!counted) {
        text << "not counted: too many of the " << own.faces.size() << " faces lie near each other";
        return Finding{"self_intersections_not_counted", static_cast<double>(own.faces.size()),
                       text.str()};
    }
    text << counted->pairs << " pairs of faces cross or overlap, " << counted->faces
         << " faces in all; they are kept";
    return Finding{"self_intersections", static_cast<double>(counted->pairs), text.str()};
}

/// What the size says about the unit, along the object's own axes as in a plan.
Result<std::optional<Finding>> check_units(const ConditionedMesh& solid, const Gripper& gripper,
                                           const PlannerConfig& config) {
    const auto X_OP = principal_frame(solid.mesh);
    if (!X_OP.ok()) return X_OP.error();
    const Eigen::Vector3d size = size_of(transformed(X_OP.value().inverse(), solid.mesh).vertices);
    return guess_units(size, {&gripper, 1}, config.guess_units);
}

/// The stages, up to the first that refuses. @return its error
std::optional<PlanError> examine(const ObjectFile& file, const Gripper& gripper,
                                 const PlannerConfig& config, Diagnosis& diagnosis) {
    const auto closed = close_object(file.object, config, diagnosis.findings);
    if (!closed.ok()) return closed.error();
    const ConditionedMesh& solid = closed.value().solid;
    diagnosis.before.holes = count_of(solid.findings, "holes_filled");
    if (diagnosis.before.holes > 0) diagnosis.before.volume_m3.reset();
    diagnosis.after = figures_of(solid);
    if (closed.value().spacing_m > 0.0) diagnosis.before.spacing_m = closed.value().spacing_m;
    if (auto crossing = crossing_faces(solid)) diagnosis.findings.push_back(*crossing);
    const auto units = check_units(solid, gripper, config);
    if (!units.ok()) return units.error();
    if (units.value()) diagnosis.findings.push_back(*units.value());
    return std::nullopt;
}

}  // namespace

Diagnosis diagnose_object(const ObjectFile& file, const Gripper& gripper,
                          const PlannerConfig& config) {
    Diagnosis diagnosis;
    diagnosis.kind = std::holds_alternative<PointCloud>(file.object) ? "cloud" : "mesh";
    diagnosis.findings = file.findings;
    diagnosis.before = figures_as_stored(file.object);
    if (const auto refused = examine(file, gripper, config, diagnosis)) {
        diagnosis.refusal = refused->detail;
    }
    diagnosis.advice = advice_for(diagnosis.findings, diagnosis.refusal);
    return diagnosis;
}

}  // namespace graspd::cli
