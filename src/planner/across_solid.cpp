#include "across_solid.hpp"

#include <algorithm>

namespace graspd::planner_detail {

AcrossSolid look_across(const PreparedObject& object, const SurfaceSampler& sampler,
                        const Gripper& gripper, const PlannerConfig& config) {
    constexpr const char* kOpposite = "grasp/opposite_candidates";
    AcrossSolid across;
    SampleSurfaceConfig coarse = config.sample_surface;
    coarse.max_samples = config.search.probe_samples;
    auto probes = sampler.sample(gripper.finger_width_m, coarse);
    if (!probes) return across;
    across.probes = std::move(probes).value();
    auto candidates = across.log.run(kOpposite, across.probes.samples.size(), [&] {
        // Beyond the opening too, so that what is too wide is counted as such later.
        return opposite_candidates(across.probes.samples, object.mesh_P, *object.tree_P,
                                   std::max(gripper.max_width_m, mesh_diagonal_m(object.mesh_P)),
                                   config.opposite_candidates);
    });
    if (!candidates) return across;
    across.candidates = std::move(candidates).value();
    across.log.out(kOpposite, across.candidates.size());
    return across;
}

AcrossSolid look_across(const PreparedObject& object, const Gripper& gripper,
                        const PlannerConfig& config) {
    const auto sampler = SurfaceSampler::of(object.mesh_P, object.field.value_m);
    return sampler ? look_across(object, sampler.value(), gripper, config) : AcrossSolid{};
}

}  // namespace graspd::planner_detail
