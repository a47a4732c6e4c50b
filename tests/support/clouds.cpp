#include "support/clouds.hpp"

#include <cmath>
#include <numbers>

namespace graspd::test {

PointCloud spiral_sphere(double radius_m, int count) {
    PointCloud cloud;
    const double golden_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double r = std::sqrt(1.0 - z * z);
        cloud.points.push_back(radius_m * Eigen::Vector3d(r * std::cos(golden_rad * i),
                                                          r * std::sin(golden_rad * i), z));
    }
    return cloud;
}

}  // namespace graspd::test
