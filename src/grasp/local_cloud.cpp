#include "graspd/grasp/local_cloud.hpp"

#include <algorithm>
#include <optional>

#include "closing_lines.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

using grasp_detail::LineHit;

std::vector<double> middles_of_cells(std::uint32_t count, double half_m) {
    std::vector<double> middles;
    for (std::uint32_t i = 0; i < count; ++i) {
        middles.push_back(half_m * ((2.0 * i + 1.0) / count - 1.0));
    }
    return middles;
}

/// The first touch of a pad and the mean of what lies within its depth; its share is the number of
/// lines that touch.
std::optional<PadTouch> touch_of(const std::vector<LineHit>& seen, double side, double max_depth_m,
                                 const TriangleMesh& mesh, const Eigen::Matrix3d& R_GW) {
    if (seen.empty()) return std::nullopt;
    const auto outward = [&](const LineHit& hit) { return side * hit.point_G.x(); };
    double first = outward(seen.front());
    for (const LineHit& hit : seen) first = std::max(first, outward(hit));
    PadTouch touch{side * first, {}, {}, 0.0};
    touch.point_G.setZero();
    touch.normal_G.setZero();
    double count = 0.0;
    for (const LineHit& hit : seen) {
        if (first - outward(hit) > max_depth_m) continue;
        const Eigen::Vector3d normal_G = R_GW * face_normal(mesh, hit.face);
        touch.point_G += hit.point_G;
        touch.normal_G += normal_G;
        count += 1.0;
    }
    touch.point_G /= count;
    touch.normal_G = touch.normal_G.stableNormalized();
    touch.share = count;
    return touch;
}

}  // namespace

Result<LocalCloud> local_cloud(const TriangleMesh& object_W, const TriangleBvh& tree_W,
                               const Eigen::Isometry3d& X_WG, const PadFootprint& footprint,
                               const LocalCloudConfig& config) {
    if (auto bad = validate(config, "local_cloud.")) return *bad;
    const auto y_G = middles_of_cells(config.lines_across, footprint.half_width_m);
    const auto z_G = middles_of_cells(config.lines_along, footprint.half_height_m);
    const auto lines = grasp_detail::closing_lines(tree_W, X_WG, y_G, z_G, footprint.half_reach_m);
    if (!lines) return lines.error();
    const auto& [left_hits, right_hits] = lines.value();
    const Eigen::Matrix3d R_GW = X_WG.linear().transpose();
    auto left = touch_of(left_hits, -1.0, config.max_depth_m, object_W, R_GW);
    auto right = touch_of(right_hits, 1.0, config.max_depth_m, object_W, R_GW);
    if (!left || !right) return PlanError{PlanErrorCode::kDegenerate, "a pad meets nothing"};
    const double count = static_cast<double>(config.lines_across) * config.lines_along;
    for (PadTouch* touch : {&*left, &*right}) touch->share /= count;
    LocalCloud cloud{{}, *left, *right, 2.0 * footprint.half_width_m / config.lines_across};
    cloud.points_G.reserve(left_hits.size() + right_hits.size());
    for (const auto* seen : {&left_hits, &right_hits}) {
        for (const LineHit& hit : *seen) cloud.points_G.push_back(hit.point_G);
    }
    return cloud;
}

}  // namespace graspd
