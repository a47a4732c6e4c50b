#include "object_concavity.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <utility>

namespace graspd::cli {
namespace {

/// A mesh and, for each record of the file, the vertex that stands for it or -1.
struct StoredMesh {
    TriangleMesh mesh;
    std::vector<std::int32_t> vertex_of_record;
};

void append(std::vector<Finding>& findings, const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
}

Result<StoredMesh> to_mesh(const ObjectFile& object, const TriangulateCloudConfig& config,
                           std::vector<Finding>& findings) {
    StoredMesh stored;
    if (const auto* mesh = std::get_if<TriangleMesh>(&object.object)) {
        stored.mesh = *mesh;
        for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
            stored.vertex_of_record.push_back(static_cast<std::int32_t>(i));
        }
        return stored;
    }
    auto surface = triangulate_cloud(std::get<PointCloud>(object.object), config);
    if (!surface.ok()) return surface.error();
    append(findings, surface.value().findings);
    stored.mesh = std::move(surface.value().mesh);
    stored.vertex_of_record = std::move(surface.value().vertex_of_point);
    return stored;
}

Result<ConcavityField> concavity_of(const TriangleMesh& mesh, const PlannerConfig& config) {
    const auto hull = outer_hull(mesh.vertices);
    if (!hull.ok()) return hull.error();
    const TriangleBvh bvh(mesh, ray_tolerance_m(mesh, config.shortest_path_concavity));
    return vertex_concavity(mesh, hull.value(), bvh, config.concavity());
}

}  // namespace

Result<ObjectConcavity> object_concavity(const ObjectFile& object, const PlannerConfig& config) {
    ObjectConcavity result;
    result.findings = object.findings;
    const auto stored = to_mesh(object, config.triangulate_cloud, result.findings);
    if (!stored.ok()) return stored.error();
    const auto closed = condition_mesh(stored.value().mesh, config.condition_mesh);
    if (!closed.ok()) return closed.error();
    append(result.findings, closed.value().findings);
    const auto field = concavity_of(closed.value().mesh, config);
    if (!field.ok()) return field.error();
    for (const std::int32_t vertex : stored.value().vertex_of_record) {
        const std::int32_t place =
            vertex < 0 ? -1 : closed.value().vertex_of_input[static_cast<std::size_t>(vertex)];
        if (place < 0) {
            result.value_m.push_back(std::numeric_limits<double>::quiet_NaN());
            result.flag.push_back(ConcavityFlag::kUnreferenced);
            continue;
        }
        result.value_m.push_back(field.value().value_m[static_cast<std::size_t>(place)]);
        ConcavityFlag flag = field.value().flag[static_cast<std::size_t>(place)];
        // The wrap's value is proven; that of the vertex, which stands beside it, is not.
        if (closed.value().alpha_wrapped && flag == ConcavityFlag::kExact) {
            flag = ConcavityFlag::kPath;
        }
        result.flag.push_back(flag);
    }
    return result;
}

std::string write_concavity(const ObjectConcavity& concavity) {
    std::string text;
    for (std::size_t i = 0; i < concavity.value_m.size(); ++i) {
        std::array<char, 32> number{};  // the longest double has 24 characters
        const auto end = std::to_chars(number.begin(), number.end(), concavity.value_m[i]).ptr;
        text += std::to_string(i) + ' ';
        text.append(number.begin(), end);
        text += ' ';
        text += to_string(concavity.flag[i]);
        text += '\n';
    }
    return text;
}

}  // namespace graspd::cli
