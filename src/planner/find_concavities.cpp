#include "find_concavities.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "graspd/base/parallel.hpp"

namespace graspd::planner_detail {
namespace {

/// Whether a region of a lower threshold is a known one that has merely grown by its margin.
bool repeats(const Concavity& region, const std::vector<Concavity>& known, double growth) {
    return std::ranges::any_of(known, [&](const Concavity& other) {
        return std::ranges::includes(region.salient, other.salient) &&
               static_cast<double>(region.salient.size()) <
                   growth * static_cast<double>(other.salient.size());
    });
}

}  // namespace

Result<std::vector<Concavity>> find_concavities(const SurfaceSamples& surface,
                                                double finger_thickness_m,
                                                const PlannerConfig& config, StageLog& log) {
    constexpr const char* kExtract = "regions/extract_concave_areas";
    constexpr const char* kCluster = "regions/cluster_concavities";
    // Which levels there are; a level whose threshold is that of the one before adds nothing.
    std::vector<ConcaveAreas> levels;
    ExtractConcaveAreasConfig extract = config.extract_concave_areas;
    for (std::uint32_t level = 0; level < config.search.levels; ++level) {
        extract.salient_fraction = config.extract_concave_areas.salient_fraction *
                                   std::pow(config.search.level_ratio, level);
        auto areas = log.run(kExtract, surface.samples.size(), [&] {
            return extract_concave_areas(surface.samples, finger_thickness_m, extract);
        });
        if (!areas) return areas.error();
        if (areas.value().salient.empty()) break;
        if (!levels.empty() && areas.value().threshold_m == levels.back().threshold_m) break;
        log.out(kExtract, areas.value().salient.size());
        log.count(kCluster, areas.value().salient.size(), 0);
        levels.push_back(std::move(areas).value());
    }
    std::vector<std::optional<Result<std::vector<Concavity>>>> clusters(levels.size());
    log.run(kCluster, 0, [&] {
        for_blocks(levels.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                clusters[i] = cluster_concavities(surface.samples, levels[i], surface.spacing_m,
                                                  config.cluster_concavities);
            }
        });
        return 0;
    });
    std::vector<Concavity> found;
    for (auto& of_level : clusters) {
        if (!*of_level) return of_level->error();
        const std::vector<Concavity> known = found;
        for (Concavity& cluster : of_level->value()) {
            if (!repeats(cluster, known, config.search.level_growth)) {
                found.push_back(std::move(cluster));
            }
        }
    }
    std::ranges::stable_sort(found, std::ranges::greater{}, &Concavity::depth_m);
    if (found.size() > config.cluster_concavities.max_concavities) {
        found.resize(config.cluster_concavities.max_concavities);
    }
    log.out(kCluster, found.size());
    return found;
}

Result<SeenSurface> see_surface(const PreparedObject& object, const Gripper& gripper,
                                const PlannerConfig& config, bool across_too, StageLog& log) {
    constexpr const char* kSample = "mesh/sample_surface";
    const auto sampler = log.run(kSample, object.mesh_P.faces.size(), [&] {
        return SurfaceSampler::of(object.mesh_P, object.field.value_m);
    });
    if (!sampler) return sampler.error();
    SeenSurface seen;
    std::optional<PlanError> bad;
    const auto look_along = [&] {
        auto surface = log.run(kSample, 0, [&] {
            return sampler.value().sample(gripper.finger_width_m, config.sample_surface);
        });
        if (!surface) return void(bad = surface.error());
        seen.surface = std::move(surface).value();
        log.out(kSample, seen.surface.samples.size());
        auto concavities = find_concavities(seen.surface, gripper.finger_thickness_m, config, log);
        if (!concavities) return void(bad = concavities.error());
        seen.concavities = std::move(concavities).value();
    };
    run_together({look_along, [&] {
                      if (across_too)
                          seen.across = look_across(object, sampler.value(), gripper, config);
                  }});
    if (bad) return *bad;
    return seen;
}

}  // namespace graspd::planner_detail
