#include "closing_lines.hpp"

#include <string>

namespace graspd::grasp_detail {
namespace {

LineHit hit_from(const Eigen::Vector3d& start_G, double sign, const TriangleBvh::Hit& hit) {
    return {start_G + Eigen::Vector3d(sign * hit.distance_m, 0.0, 0.0), hit.distance_m, hit.face};
}

PlanError begins_inside(const char* which) {
    return {PlanErrorCode::kDegenerate,
            std::string("the ") + which + " finger begins in the object"};
}

}  // namespace

Result<ClosingLines> closing_lines(const TriangleBvh& tree_W, const Eigen::Isometry3d& X_WG,
                                   std::span<const double> y_G, std::span<const double> z_G,
                                   double half_reach_m) {
    ClosingLines lines;
    const auto hits = tree_W.hits_from_ends({X_WG, half_reach_m, y_G, z_G});
    auto line = hits.begin();
    for (const double y : y_G) {
        for (const double z : z_G) {
            const auto& [left, right] = *line++;
            if (left) {
                if (!left->from_outside) return begins_inside("left");
                lines.left.push_back(hit_from({-half_reach_m, y, z}, 1.0, *left));
            }
            if (right) {
                if (!right->from_outside) return begins_inside("right");
                lines.right.push_back(hit_from({half_reach_m, y, z}, -1.0, *right));
            }
        }
    }
    return lines;
}

}  // namespace graspd::grasp_detail
