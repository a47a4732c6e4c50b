// What tells one prepared object from another: the object's geometry, and the settings that its
// preparation depends on.
#include <span>
#include <type_traits>

#include "graspd/base/content_hash.hpp"
#include "graspd/base/heap_bytes.hpp"
#include "graspd/planner/planner.hpp"
#include "prepare_object.hpp"

namespace graspd {
namespace {

/// Strings together the values of settings, in the order of describe().
struct SettingBytes {
    std::string bytes;

    template <Settings Group>
    void operator()(const char*, Group& group) {
        std::remove_const_t<Group>::describe(group, *this);
    }
    template <class T, class... Range>
    requires std::is_arithmetic_v<T>
    void operator()(const char*, const T& value, Range...) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class... Range>
    void operator()(const char*, const std::string& text, Range...) {
        bytes += text;
        bytes += '\0';
    }
};

std::uint64_t owned_bytes(const std::vector<Finding>& findings) {
    std::uint64_t bytes = heap_bytes(findings);
    for (const Finding& finding : findings) {
        bytes += heap_bytes(finding.code) + heap_bytes(finding.detail);
    }
    return bytes;
}

std::uint64_t owned_bytes(const ConcavityField& field) {
    return heap_bytes(field.value_m) + heap_bytes(field.flag) + heap_bytes(field.parent) +
           heap_bytes(field.edge_bends) + heap_bytes(field.lifted);
}

}  // namespace

std::string planner_detail::settings_of_preparation(const PlannerConfig& config) {
    SettingBytes settings;
    settings("", config.triangulate_cloud);
    settings("", config.condition_mesh);
    settings("", config.face_sensor);
    settings("", config.vertex_concavity);
    settings("", config.shortest_path_concavity);
    settings("", config.tetrahedral_concavity);
    settings("", config.search.exact_concavity);
    return std::move(settings.bytes);
}

std::string object_key_of(const std::variant<TriangleMesh, PointCloud>& object_O) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&object_O)) {
        return content_key(
            {std::as_bytes(std::span(mesh->vertices)), std::as_bytes(std::span(mesh->faces))});
    }
    const auto& cloud = std::get<PointCloud>(object_O);
    const auto origin = cloud.sensor_origin.value_or(Eigen::Vector3d::Zero());
    const std::span<const double> of_origin(origin.data(), cloud.sensor_origin ? 3 : 0);
    return content_key({std::as_bytes(std::span(cloud.points)), {}, std::as_bytes(of_origin)});
}

std::uint64_t memory_bytes(const PreparedObject& object) {
    std::uint64_t bytes = sizeof object + heap_bytes(object.object_key) +
                          heap_bytes(object.settings) + heap_bytes(object.stages);
    for (const StageReport& stage : object.stages) bytes += heap_bytes(stage.name);
    bytes += heap_bytes(object.mesh_P.vertices) + heap_bytes(object.mesh_P.faces);
    bytes += heap_bytes(object.hull_P.facets) + heap_bytes(object.hull_P.vertices);
    if (object.tree_P) bytes += object.tree_P->bytes();
    return bytes + owned_bytes(object.field) + owned_bytes(object.findings);
}

}  // namespace graspd
