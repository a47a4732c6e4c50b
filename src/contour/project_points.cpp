#include "graspd/contour/project_points.hpp"

namespace graspd {

std::vector<Eigen::Vector2d> project_points(std::span<const Eigen::Vector3d> points_O,
                                            const Eigen::Isometry3d& X_OW) {
    const Eigen::Isometry3d X_WO = X_OW.inverse();
    std::vector<Eigen::Vector2d> points_W;
    points_W.reserve(points_O.size());
    for (const Eigen::Vector3d& point_O : points_O) {
        const Eigen::Vector3d point_W = X_WO * point_O;
        points_W.push_back(point_W.head<2>());
    }
    return points_W;
}

}  // namespace graspd
