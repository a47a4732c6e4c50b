#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <string>

#include <pcl/features/normal_3d.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/impl/gp3.hpp>

#include "cloud_surface.hpp"

namespace graspd::mesh_detail {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// PCL's advice for scans: triangles between 10 and 120 degrees, patches that bend by up to 45.
constexpr double kLeastAngle_rad = 10.0 * kDegree;
constexpr double kMostAngle_rad = 120.0 * kDegree;
constexpr double kMostBend_rad = 45.0 * kDegree;
constexpr int kMostNeighbours = 100;

template <class Point>
typename pcl::PointCloud<Point>::Ptr to_pcl(const std::vector<Eigen::Vector3d>& points) {
    auto cloud = pcl::make_shared<pcl::PointCloud<Point>>();
    cloud->resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        (*cloud)[i].getVector3fMap() = points[i].cast<float>();
    }
    return cloud;
}

PlanError failed(const std::exception& error) {
    return {PlanErrorCode::kInternal,
            std::string("triangulate_cloud: PCL failed: ") + error.what()};
}

std::vector<Triangle> to_triangles(const std::vector<pcl::Vertices>& polygons) {
    std::vector<Triangle> triangles;
    for (const pcl::Vertices& polygon : polygons) {
        if (polygon.vertices.size() != 3) continue;
        triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                             static_cast<std::uint32_t>(polygon.vertices[1]),
                             static_cast<std::uint32_t>(polygon.vertices[2])});
    }
    return triangles;
}

}  // namespace

Result<double> median_spacing(const std::vector<Eigen::Vector3d>& points) {
    try {
        const auto cloud = to_pcl<pcl::PointXYZ>(points);
        pcl::KdTreeFLANN<pcl::PointXYZ> tree;
        tree.setInputCloud(cloud);
        std::vector<double> distances;
        pcl::Indices found(2);
        std::vector<float> squared(2);
        for (const pcl::PointXYZ& point : *cloud) {
            if (tree.nearestKSearch(point, 2, found, squared) < 2) continue;
            distances.push_back(std::sqrt(static_cast<double>(squared[1])));
        }
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        return *middle;
    } catch (const std::exception& error) {
        return failed(error);
    }
}

Result<std::vector<Triangle>> project_greedily(const std::vector<Eigen::Vector3d>& points,
                                               double spacing,
                                               const TriangulateCloudConfig& config) {
    using Point = pcl::PointNormal;
    try {
        const auto cloud = to_pcl<Point>(points);
        auto tree = pcl::make_shared<pcl::search::KdTree<Point>>();
        pcl::NormalEstimation<Point, Point> normals;
        normals.setInputCloud(cloud);
        normals.setSearchMethod(tree);
        normals.setKSearch(static_cast<int>(config.normal_neighbours));
        normals.compute(*cloud);
        pcl::GreedyProjectionTriangulation<Point> greedy;
        greedy.setInputCloud(cloud);
        greedy.setSearchMethod(tree);
        greedy.setSearchRadius(config.radius_spacings * spacing);
        greedy.setMu(config.mu);
        greedy.setMaximumNearestNeighbors(kMostNeighbours);
        greedy.setMinimumAngle(kLeastAngle_rad);
        greedy.setMaximumAngle(kMostAngle_rad);
        greedy.setMaximumSurfaceAngle(kMostBend_rad);
        std::vector<pcl::Vertices> polygons;
        greedy.reconstruct(polygons);
        return to_triangles(polygons);
    } catch (const std::exception& error) {
        return failed(error);
    }
}

}  // namespace graspd::mesh_detail
