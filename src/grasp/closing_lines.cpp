#include "closing_lines.hpp"

namespace graspd::grasp_detail {

std::optional<std::vector<LineHit>> closing_lines(const TriangleBvh& tree_W,
                                                  const Eigen::Isometry3d& X_WG,
                                                  std::span<const double> y_G,
                                                  std::span<const double> z_G, double half_reach_m,
                                                  double side) {
    std::vector<LineHit> hits;
    const Eigen::Vector3d direction_W = -side * X_WG.linear().col(0);
    for (const double y : y_G) {
        for (const double z : z_G) {
            const Eigen::Vector3d start_G(side * half_reach_m, y, z);
            const auto hit = tree_W.first_hit(X_WG * start_G, direction_W, 2.0 * half_reach_m);
            if (!hit) continue;
            if (!hit->from_outside) return std::nullopt;
            hits.push_back({start_G - Eigen::Vector3d(side * hit->distance_m, 0.0, 0.0),
                            hit->distance_m, hit->face});
        }
    }
    return hits;
}

}  // namespace graspd::grasp_detail
