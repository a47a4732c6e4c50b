#include "graspd/mesh/segment_scene.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include "graspd/base/disjoint_sets.hpp"
#include "graspd/base/point_grid.hpp"
#include "graspd/base/settings.hpp"
#include "plan_error_text.hpp"
#include "thin_cloud.hpp"

namespace graspd {
namespace {

using mesh_detail::error;

// [1] Of the points: a smaller plane is a side of something, not what things stand on.
constexpr double kLeastPlane = 0.1;

struct Plane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    double offset_m = 0.0;

    double height_m(const Eigen::Vector3d& point) const { return normal.dot(point) - offset_m; }
};

/// The plane that most points are near to.
Result<Plane> largest_plane(const std::vector<Eigen::Vector3d>& points,
                            const SegmentSceneConfig& config) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) box.extend(point);
    const Eigen::Vector3d middle = box.center();  // PCL works in float
    auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    cloud->resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        (*cloud)[i].getVector3fMap() = (points[i] - middle).cast<float>();
    }
    pcl::Indices near;
    Eigen::VectorXf first, refined;
    try {
        auto model = pcl::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(cloud);
        pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, config.plane_within_m);
        ransac.setMaxIterations(static_cast<int>(config.rounds));
        if (!ransac.computeModel()) {
            return error(PlanErrorCode::kDegenerate, "scene of ", points.size(),
                         " points has no plane");
        }
        ransac.getInliers(near);
        ransac.getModelCoefficients(first);
        model->optimizeModelCoefficients(near, first, refined);
        model->selectWithinDistance(refined, config.plane_within_m, near);
    } catch (const std::exception& failed) {
        return error(PlanErrorCode::kInternal, "segment_scene: PCL failed: ", failed.what());
    }
    const double share = static_cast<double>(near.size()) / static_cast<double>(points.size());
    if (share < kLeastPlane) {
        return error(PlanErrorCode::kDegenerate, "scene's largest plane holds ", near.size(),
                     " of ", points.size(), " points, a tenth is needed");
    }
    Plane plane;
    plane.normal = refined.head<3>().cast<double>().normalized();
    plane.offset_m = plane.normal.dot(middle) - static_cast<double>(refined[3]);
    return plane;
}

/// Turns the normal to the sensor, or to where most points are.
void turn_to_objects(const std::vector<Eigen::Vector3d>& points,
                     const std::optional<Eigen::Vector3d>& sensor, const SegmentSceneConfig& config,
                     Plane& plane) {
    std::ptrdiff_t balance = 0;  // of points above over points below
    for (const Eigen::Vector3d& point : points) {
        const double height_m = plane.height_m(point);
        if (std::abs(height_m) > config.plane_within_m) balance += height_m > 0.0 ? 1 : -1;
    }
    if (sensor ? plane.height_m(*sensor) >= 0.0 : balance >= 0) return;
    plane.normal = -plane.normal;
    plane.offset_m = -plane.offset_m;
}

/// Groups that hang together, the largest first.
std::vector<PointCloud> group(const std::vector<Eigen::Vector3d>& points, double gap_m,
                              std::size_t least) {
    const PointGrid grid(points, gap_m);
    DisjointSets sets(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        grid.each_within(points[i], gap_m, [&](std::uint32_t other) {
            if (other > i) sets.unite(i, other);
            return true;
        });
    }
    std::vector<PointCloud> groups(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        groups[sets.find(i)].points.push_back(points[i]);
    }
    std::erase_if(groups, [&](const PointCloud& g) { return g.points.size() < least; });
    std::ranges::stable_sort(groups, std::ranges::greater(),
                             [](const PointCloud& g) { return g.points.size(); });
    return groups;
}

double longest_side_m(const PointCloud& cloud) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : cloud.points) box.extend(point);
    return box.sizes().maxCoeff();
}

}  // namespace

Result<SegmentedScene> segment_scene(const PointCloud& cloud, const SegmentSceneConfig& config) {
    if (auto bad = validate(config, "segment_scene.")) return *bad;
    const std::vector<Eigen::Vector3d> points =
        std::move(mesh_detail::thin_cloud(cloud.points, config.max_points).points);
    if (points.size() < 3) {
        return error(PlanErrorCode::kInvalidInput, "scene has ", points.size(),
                     " finite distinct points of ", cloud.points.size());
    }
    auto found = largest_plane(points, config);
    if (!found) return found.error();
    Plane& plane = found.value();
    turn_to_objects(points, cloud.sensor_origin, config, plane);
    std::vector<Eigen::Vector3d> above;
    std::ranges::copy_if(points, std::back_inserter(above), [&](const Eigen::Vector3d& point) {
        return plane.height_m(point) > config.plane_within_m;
    });
    SegmentedScene scene{plane.normal, plane.offset_m, {}, {}};
    for (PointCloud& each : group(above, config.gap_m, config.least_points)) {
        each.sensor_origin = cloud.sensor_origin;
        const bool large = longest_side_m(each) > config.largest_m;
        (large ? scene.background : scene.objects).push_back(std::move(each));
    }
    if (scene.objects.empty()) {
        return error(PlanErrorCode::kDegenerate,
                     "nothing stands on the scene's plane: ", above.size(), " points above it, ",
                     scene.background.size(), " groups larger than ", config.largest_m,
                     " m, none of at least ", config.least_points, " points that is smaller");
    }
    return scene;
}

}  // namespace graspd
