#include "graspd/regions/cluster_concavities.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <string>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include "graspd/base/plane_points.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Indices = std::vector<std::uint32_t>;

// Grid neighbours lie at whole multiples of the spacing: distances that equal a limit up to PCL's
// floats are within it, whichever way they are rounded.
constexpr double kTie = 1.0 + 1e-5;

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

/// The samples' points relative to `center`, since PCL keeps them in float.
Cloud::Ptr make_cloud(std::span<const SurfaceSample> samples, const Indices& indices,
                      const Eigen::Vector3d& center) {
    auto cloud = pcl::make_shared<Cloud>();
    cloud->reserve(indices.size());
    for (const std::uint32_t i : indices) {
        const Eigen::Vector3f p = (samples[i].point - center).cast<float>();
        cloud->emplace_back(p.x(), p.y(), p.z());
    }
    return cloud;
}

Eigen::AlignedBox3d bounds_of(std::span<const SurfaceSample> samples, const Indices& indices) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t i : indices) box.extend(samples[i].point);
    return box;
}

/// Indices into `salient` of each cluster; their order is PCL's.
std::vector<pcl::PointIndices> euclidean_clusters(const Cloud::Ptr& cloud, double tolerance_m,
                                                  std::uint32_t min_samples) {
    auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
    extraction.setClusterTolerance(tolerance_m * kTie);
    extraction.setMinClusterSize(static_cast<pcl::uindex_t>(min_samples));
    extraction.setMaxClusterSize(std::numeric_limits<pcl::index_t>::max());
    extraction.setSearchMethod(tree);
    extraction.setInputCloud(cloud);
    std::vector<pcl::PointIndices> clusters;
    extraction.extract(clusters);
    return clusters;
}

/// The samples among `enlarged` within `reach_m` of a salient one, and every salient one.
Indices surroundings(std::span<const SurfaceSample> samples, const Indices& salient,
                     const Indices& enlarged, double reach_m) {
    Eigen::AlignedBox3d box = bounds_of(samples, salient);
    const Eigen::Vector3d center = box.center();
    pcl::search::KdTree<pcl::PointXYZ> tree;
    tree.setInputCloud(make_cloud(samples, salient, center));
    const Eigen::Vector3d pad = Eigen::Vector3d::Constant(reach_m * kTie);
    box = Eigen::AlignedBox3d(box.min() - pad, box.max() + pad);

    Indices around;
    pcl::Indices nearest(1);
    std::vector<float> squared(1);
    for (const std::uint32_t i : enlarged) {
        if (!box.contains(samples[i].point)) continue;
        const Eigen::Vector3f p = (samples[i].point - center).cast<float>();
        if (tree.nearestKSearch({p.x(), p.y(), p.z()}, 1, nearest, squared) != 1) continue;
        const Eigen::Vector3d& to = samples[salient[nearest.front()]].point;
        if ((samples[i].point - to).norm() <= reach_m * kTie) around.push_back(i);
    }
    Indices all;
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
    const auto cloud =
        make_cloud(samples, areas.salient, bounds_of(samples, areas.salient).center());
    std::vector<Concavity> concavities;
    for (const pcl::PointIndices& cluster :
         euclidean_clusters(cloud, config.tolerance_spacings * spacing_m, config.min_samples)) {
        Concavity& concavity = concavities.emplace_back();
        for (const auto k : cluster.indices) {
            const std::uint32_t i = areas.salient[k];
            concavity.salient.push_back(i);
            concavity.depth_m = std::max(concavity.depth_m, samples[i].concavity_m);
        }
        std::ranges::sort(concavity.salient);
    }
    std::ranges::sort(concavities, comes_before);
    if (concavities.size() > config.max_concavities) concavities.resize(config.max_concavities);
    Indices enlarged = areas.enlarged;
    std::ranges::sort(enlarged);
    for (Concavity& concavity : concavities) {
        concavity.enlarged = surroundings(samples, concavity.salient, enlarged,
                                          config.enlargement_spacings * spacing_m);
    }
    return concavities;
}

}  // namespace

Result<std::vector<Concavity>> cluster_concavities(std::span<const SurfaceSample> samples,
                                                   const ConcaveAreas& areas, double spacing_m,
                                                   const ClusterConcavitiesConfig& config) {
    if (auto bad = check_input(samples, areas, spacing_m, config)) return *bad;
    if (areas.salient.empty()) return std::vector<Concavity>{};
    try {
        return find_concavities(samples, areas, spacing_m, config);
    } catch (const std::exception& exception) {
        return PlanError{PlanErrorCode::kInternal,
                         std::string("cluster_concavities: PCL: ") + exception.what()};
    }
}

}  // namespace graspd
