#include "object_concavity.hpp"

#include <array>
#include <charconv>
#include <limits>

#include "close_object.hpp"

namespace graspd::cli {
namespace {

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
    const auto closed = close_object(object.object, config, result.findings);
    if (!closed.ok()) return closed.error();
    const ConditionedMesh& solid = closed.value().solid;
    const auto field = concavity_of(solid.mesh, config);
    if (!field.ok()) return field.error();
    for (const std::int32_t place : closed.value().vertex_of_record) {
        if (place < 0) {
            result.value_m.push_back(std::numeric_limits<double>::quiet_NaN());
            result.flag.push_back(ConcavityFlag::kUnreferenced);
            continue;
        }
        result.value_m.push_back(field.value().value_m[static_cast<std::size_t>(place)]);
        ConcavityFlag flag = field.value().flag[static_cast<std::size_t>(place)];
        // The wrap's value is proven; that of the vertex, which stands beside it, is not.
        if (solid.alpha_wrapped && flag == ConcavityFlag::kExact) {
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
