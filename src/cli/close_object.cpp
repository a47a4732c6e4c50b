#include "close_object.hpp"

#include <utility>

namespace graspd::cli {
namespace {

void append(std::vector<Finding>& findings, const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
}

Result<ClosedObject> close_cloud(const PointCloud& cloud, const PlannerConfig& config,
                                 std::vector<Finding>& findings) {
    auto surface = triangulate_cloud(cloud, config.triangulate_cloud);
    if (!surface.ok()) return surface.error();
    append(findings, surface.value().findings);
    auto closed = condition_mesh(surface.value().mesh, config.condition_mesh);
    if (!closed.ok()) return closed.error();
    closed = face_sensor(std::move(closed).value(), cloud.sensor_origin, config.condition_mesh,
                         config.face_sensor);
    if (!closed.ok()) return closed.error();
    append(findings, closed.value().findings);
    ClosedObject object{std::move(closed).value(), std::move(surface.value().vertex_of_point),
                        surface.value().spacing_m};
    for (std::int32_t& vertex : object.vertex_of_record) {
        if (vertex < 0) continue;
        vertex = object.solid.vertex_of_input[static_cast<std::size_t>(vertex)];
    }
    return object;
}

}  // namespace

Result<ClosedObject> close_object(const std::variant<TriangleMesh, PointCloud>& object,
                                  const PlannerConfig& config, std::vector<Finding>& findings) {
    const auto* mesh = std::get_if<TriangleMesh>(&object);
    if (mesh == nullptr) return close_cloud(std::get<PointCloud>(object), config, findings);
    auto closed = condition_mesh(*mesh, config.condition_mesh);
    if (!closed.ok()) return closed.error();
    append(findings, closed.value().findings);
    ClosedObject result{std::move(closed).value(), {}, 0.0};
    result.vertex_of_record = result.solid.vertex_of_input;
    return result;
}

}  // namespace graspd::cli
