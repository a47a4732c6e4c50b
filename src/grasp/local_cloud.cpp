#include "graspd/grasp/local_cloud.hpp"

#include <algorithm>
#include <optional>

#include "closing_lines.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

/// A place where a line along Gx enters the object, seen from one side.
struct Seen {
    Eigen::Vector3d point_G;
    Eigen::Vector3d normal_G;
};

std::vector<double> middles_of_cells(std::uint32_t count, double half_m) {
    std::vector<double> middles;
    for (std::uint32_t i = 0; i < count; ++i) {
        middles.push_back(half_m * ((2.0 * i + 1.0) / count - 1.0));
    }
    return middles;
}

/// Lines along one direction of Gx; `side` is -1 for the pad that comes from -Gx.
/// None when a line begins inside the object: the pad cannot stand there.
std::optional<std::vector<Seen>> look(const TriangleMesh& mesh, const TriangleBvh& tree,
                                      const Eigen::Isometry3d& X_WG, const PadFootprint& pad,
                                      const LocalCloudConfig& config, double side) {
    const auto hits = grasp_detail::closing_lines(
        tree, X_WG, middles_of_cells(config.lines_across, pad.half_width_m),
        middles_of_cells(config.lines_along, pad.half_height_m), pad.half_reach_m, side);
    if (!hits) return std::nullopt;
    const Eigen::Matrix3d R_GW = X_WG.linear().transpose();
    std::vector<Seen> seen;
    seen.reserve(hits->size());
    for (const grasp_detail::LineHit& hit : *hits) {
        seen.push_back({hit.point_G, R_GW * face_normal(mesh, hit.face)});
    }
    return seen;
}

/// The first touch of a pad and the mean of what lies within its depth.
std::optional<PadTouch> touch_of(const std::vector<Seen>& seen, double side, double max_depth_m,
                                 double lines) {
    if (seen.empty()) return std::nullopt;
    const auto outward = [&](const Seen& s) { return side * s.point_G.x(); };
    double first = outward(seen.front());
    for (const Seen& s : seen) first = std::max(first, outward(s));
    PadTouch touch{side * first, {}, {}, 0.0};
    touch.point_G.setZero();
    touch.normal_G.setZero();
    double count = 0.0;
    for (const Seen& s : seen) {
        if (first - outward(s) > max_depth_m) continue;
        touch.point_G += s.point_G;
        touch.normal_G += s.normal_G;
        count += 1.0;
    }
    touch.point_G /= count;
    touch.normal_G = touch.normal_G.stableNormalized();
    touch.share = count / lines;
    return touch;
}

}  // namespace

Result<LocalCloud> local_cloud(const TriangleMesh& object_W, const TriangleBvh& tree_W,
                               const Eigen::Isometry3d& X_WG, const PadFootprint& footprint,
                               const LocalCloudConfig& config) {
    if (auto bad = validate(config, "local_cloud.")) return *bad;
    const auto left = look(object_W, tree_W, X_WG, footprint, config, -1.0);
    if (!left) return PlanError{PlanErrorCode::kDegenerate, "the left pad begins in the object"};
    const auto right = look(object_W, tree_W, X_WG, footprint, config, 1.0);
    if (!right) return PlanError{PlanErrorCode::kDegenerate, "the right pad begins in the object"};
    const double lines = static_cast<double>(config.lines_across) * config.lines_along;
    const auto left_touch = touch_of(*left, -1.0, config.max_depth_m, lines);
    const auto right_touch = touch_of(*right, 1.0, config.max_depth_m, lines);
    if (!left_touch || !right_touch) {
        return PlanError{PlanErrorCode::kDegenerate, "a pad meets nothing"};
    }
    LocalCloud cloud{
        {}, *left_touch, *right_touch, 2.0 * footprint.half_width_m / config.lines_across};
    cloud.points_G.reserve(left->size() + right->size());
    for (const Seen& s : *left) cloud.points_G.push_back(s.point_G);
    for (const Seen& s : *right) cloud.points_G.push_back(s.point_G);
    return cloud;
}

}  // namespace graspd
