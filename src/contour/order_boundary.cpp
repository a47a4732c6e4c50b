#include "graspd/contour/order_boundary.hpp"

#include <algorithm>
#include <utility>

#include "graspd/base/plane_points.hpp"

namespace graspd {

std::vector<Eigen::Vector2d> order_boundary(std::vector<Eigen::Vector2d> points) {
    std::ranges::sort(points, lexicographic_less);
    for (auto used = points.begin(); used != points.end() && used + 1 != points.end(); ++used) {
        const Eigen::Vector2d current = *used;
        // The rest stays sorted, so the first of equally near points is the lexicographic least.
        const auto nearest = std::min_element(
            used + 1, points.end(), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                return (a - current).squaredNorm() < (b - current).squaredNorm();
            });
        std::rotate(used + 1, nearest, nearest + 1);
    }
    return points;
}

}  // namespace graspd
