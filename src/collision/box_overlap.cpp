#include "box_overlap.hpp"

#include <array>
#include <cmath>

namespace graspd::collision_detail {

// The difference of both bodies is a zonotope: the sum of seven segments, three edges of each box
// and the way. A face of it is spanned by two of them, so its normals are their products.
bool boxes_meet(const OrientedBox& standing, const OrientedBox& moving,
                const Eigen::Vector3d& way_W) {
    std::array<Eigen::Vector3d, 7> halves;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        halves[i] = standing.half_extent[k] * standing.pose.linear().col(k);
        halves[i + 3] = moving.half_extent[k] * moving.pose.linear().col(k);
    }
    halves[6] = 0.5 * way_W;
    const Eigen::Vector3d apart =
        moving.pose.translation() + 0.5 * way_W - standing.pose.translation();
    for (std::size_t i = 0; i < halves.size(); ++i) {
        for (std::size_t j = i + 1; j < halves.size(); ++j) {
            const Eigen::Vector3d axis = halves[i].cross(halves[j]);
            double reach = 0.0;
            for (const Eigen::Vector3d& half : halves) reach += std::abs(axis.dot(half));
            if (std::abs(axis.dot(apart)) > reach) return false;
        }
    }
    return true;
}

}  // namespace graspd::collision_detail
