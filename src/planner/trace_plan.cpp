#include "trace_plan.hpp"

#include <algorithm>

namespace graspd::planner_detail {

void trace_object(const Eigen::Isometry3d& X_FP, const PreparedObject& object,
                  const Eigen::Vector3d& center_of_mass_P, PlanTrace& trace) {
    trace.X_FP = X_FP;
    trace.object = {object.mesh_P,     object.field.value_m,   object.field.largest_m,
                    object.field.flag, object.hull_P.vertices, object.volume_m3,
                    center_of_mass_P};
}

void trace_search(const PlanRequest& request, const std::vector<SeenSurface>& seen,
                  const Found& found, PlanTrace& trace) {
    const std::size_t searched = std::min(seen.size(), found.boundaries.size());
    for (std::size_t i = 0; i < searched; ++i) {
        trace.searches.push_back(
            {request.grippers[i].name, seen[i].surface, seen[i].concavities, found.boundaries[i]});
    }
    trace.candidates = found.rejections.traced_candidates();
}

}  // namespace graspd::planner_detail
