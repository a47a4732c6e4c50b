#include "graspd/regions/cluster_concavities.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "graspd/base/disjoint_sets.hpp"
#include "graspd/base/parallel.hpp"
#include "graspd/base/plane_points.hpp"
#include "graspd/base/point_grid.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

using Indices = std::vector<std::uint32_t>;

// Grid neighbours lie at whole multiples of the spacing: distances that equal a limit up to
// rounding are within it.
constexpr double kReachTie = 1.0 + 1e-5;

PlanError invalid(const std::string& detail) {
    return {PlanErrorCode::kInvalidInput, "cluster_concavities: " + detail};
}

std::optional<PlanError> check_indices(std::span<const SurfaceSample> samples, const char* name,
                                       const Indices& indices) {
    for (const std::uint32_t i : indices) {
        if (i >= samples.size()) {
            return invalid(std::string(name) + " names sample " + std::to_string(i) + " of " +
                           std::to_string(samples.size()));
        }
        if (!samples[i].point.allFinite()) {
            return invalid("samples[" + std::to_string(i) + "].point is not finite");
        }
    }
    return std::nullopt;
}

std::optional<PlanError> check_input(std::span<const SurfaceSample> samples,
                                     const ConcaveAreas& areas, double spacing_m,
                                     const ClusterConcavitiesConfig& config) {
    if (auto bad = validate(config, "cluster_concavities.")) return bad;
    if (auto bad = check_positive("cluster_concavities: spacing_m", spacing_m)) return bad;
    if (auto bad = check_indices(samples, "areas.salient", areas.salient)) return bad;
    return check_indices(samples, "areas.enlarged", areas.enlarged);
}

std::vector<Eigen::Vector3d> points_of(std::span<const SurfaceSample> samples,
                                       const Indices& indices) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(indices.size());
    for (const std::uint32_t i : indices) points.push_back(samples[i].point);
    return points;
}

/// Clusters of samples that a chain of steps of at most `tolerance_m` connects, as rising indices.
std::vector<Indices> euclidean_clusters(std::span<const SurfaceSample> samples,
                                        const Indices& indices, double tolerance_m) {
    const auto points = points_of(samples, indices);
    const PointGrid grid(points, tolerance_m);
    DisjointSets sets(points.size());
    grid.each_pair_within(tolerance_m,
                          [&](std::uint32_t i, std::uint32_t other) { sets.unite(i, other); });
    std::map<std::uint32_t, Indices> by_first;
    for (std::uint32_t i = 0; i < points.size(); ++i) by_first[sets.find(i)].push_back(indices[i]);
    std::vector<Indices> clusters;
    for (auto& [first, cluster] : by_first) {
        std::ranges::sort(cluster);
        clusters.push_back(std::move(cluster));
    }
    return clusters;
}

/// The samples among `enlarged` within `reach_m` of a salient one, and every salient one. Both are
/// rising, so is the result.
Indices surroundings(std::span<const SurfaceSample> samples, const Indices& salient,
                     const Indices& enlarged, double spacing_m, double reach_m) {
    const auto points = points_of(samples, salient);
    const PointGrid grid(points, std::max(reach_m, spacing_m));
    Eigen::AlignedBox3d near;
    for (const Eigen::Vector3d& point : points) near.extend(point);
    // A little more than the reach: the distance decides, the box only saves asking for it.
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(reach_m * kReachTie);
    near = Eigen::AlignedBox3d(near.min() - pad, near.max() + pad);
    Indices outside, around;
    std::ranges::set_difference(enlarged, salient, std::back_inserter(outside));
    for (const std::uint32_t i : outside) {
        if (!near.contains(samples[i].point)) continue;
        const bool far =
            grid.each_within(samples[i].point, reach_m, [](std::uint32_t) { return false; });
        if (!far) around.push_back(i);
    }
    Indices all;
    all.reserve(salient.size() + around.size());
    std::ranges::set_union(salient, around, std::back_inserter(all));
    return all;
}

bool comes_before(const Concavity& a, const Concavity& b) {
    if (a.depth_m != b.depth_m) return a.depth_m > b.depth_m;
    if (a.salient.size() != b.salient.size()) return a.salient.size() > b.salient.size();
    return a.salient.front() < b.salient.front();
}

std::vector<Concavity> find_concavities(std::span<const SurfaceSample> samples,
                                        const ConcaveAreas& areas, double spacing_m,
                                        const ClusterConcavitiesConfig& config) {
    std::vector<Concavity> concavities;
    for (Indices& cluster : euclidean_clusters(samples, areas.salient,
                                               config.tolerance_spacings * spacing_m * kReachTie)) {
        if (cluster.size() < config.min_samples) continue;
        Concavity& concavity = concavities.emplace_back();
        concavity.salient = std::move(cluster);
        for (const std::uint32_t i : concavity.salient) {
            concavity.depth_m = std::max(concavity.depth_m, samples[i].concavity_m);
        }
    }
    std::ranges::sort(concavities, comes_before);
    if (concavities.size() > config.max_concavities) concavities.resize(config.max_concavities);
    Indices enlarged = areas.enlarged;
    std::ranges::sort(enlarged);
    for_blocks(concavities.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Concavity& concavity = concavities[i];
            concavity.enlarged = surroundings(samples, concavity.salient, enlarged, spacing_m,
                                              config.enlargement_spacings * spacing_m * kReachTie);
        }
    });
    return concavities;
}

}  // namespace

Result<std::vector<Concavity>> cluster_concavities(std::span<const SurfaceSample> samples,
                                                   const ConcaveAreas& areas, double spacing_m,
                                                   const ClusterConcavitiesConfig& config) {
    if (auto bad = check_input(samples, areas, spacing_m, config)) return *bad;
    if (areas.salient.empty()) return std::vector<Concavity>{};
    return find_concavities(samples, areas, spacing_m, config);
}

}  // namespace graspd
