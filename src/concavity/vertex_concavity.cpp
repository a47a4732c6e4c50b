#include "graspd/concavity/vertex_concavity.hpp"

#include <algorithm>

namespace graspd {

Result<ConcavityMethod> concavity_method(const VertexConcavityConfig& config) {
    if (auto bad = validate(config, "vertex_concavity.")) return *std::move(bad);
    const auto place = std::ranges::find(kConcavityMethods, config.method);
    return static_cast<ConcavityMethod>(place - kConcavityMethods.begin());
}

Result<ConcavityField> vertex_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                        const TriangleBvh& bvh, const ConcavitySettings& settings) {
    const auto method = concavity_method(settings.choice);
    if (!method) return method.error();
    switch (method.value()) {
        case ConcavityMethod::kAnyAngle:
            return shortest_path_concavity(mesh, hull, bvh, settings.any_angle);
        case ConcavityMethod::kTetrahedral:
            return tetrahedral_concavity(mesh, hull, bvh, settings.tetrahedral);
    }
    return PlanError{PlanErrorCode::kInternal, "no such concavity method"};
}

}  // namespace graspd
