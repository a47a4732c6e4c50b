#include "graspd/grasp/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

/// A cell of a finger's face that sees the object.
struct Seen {
    Eigen::Vector3d point_G;
    double advance_m = 0.0;  ///< [m] that the face goes before this cell touches
};

double middle_of_cell(std::uint32_t index, std::uint32_t count, double from, double to) {
    return from + (to - from) * (index + 0.5) / count;
}

/// Lines from the face towards the object; `side` is -1 for the finger at -Gx. None when a line
/// begins inside the object.
std::optional<std::vector<Seen>> look(const TriangleBvh& tree, const Eigen::Isometry3d& X_WG,
                                      const FingerFace& face, const ContactPatchConfig& config,
                                      double side) {
    std::vector<Seen> seen;
    const Eigen::Vector3d direction_W = -side * X_WG.linear().col(0);
    for (std::uint32_t i = 0; i < config.lines_across; ++i) {
        for (std::uint32_t j = 0; j < config.lines_along; ++j) {
            const Eigen::Vector3d start_G(
                side * face.half_reach_m,
                middle_of_cell(i, config.lines_across, -face.half_width_m, face.half_width_m),
                middle_of_cell(j, config.lines_along, face.from_z_m, face.to_z_m));
            const auto hit = tree.first_hit(X_WG * start_G, direction_W, 2.0 * face.half_reach_m);
            if (!hit) continue;
            if (!hit->from_outside) return std::nullopt;
            seen.push_back(
                {start_G - Eigen::Vector3d(side * hit->distance_m, 0.0, 0.0), hit->distance_m});
        }
    }
    return seen;
}

/// The cell's own size counts: a patch of one cell is as wide as that.
double half_extent_m(double variance, double cell_m) {
    return std::sqrt(3.0 * variance + 0.25 * cell_m * cell_m);
}

ContactPatch press(const std::vector<Seen>& seen, const FingerFace& face,
                   const ContactPatchConfig& config) {
    const double first_m = std::ranges::min(seen, {}, &Seen::advance_m).advance_m;
    const auto pressure = [&](const Seen& cell) {
        return std::max(0.0, 1.0 - (cell.advance_m - first_m) / config.compression_m);
    };
    ContactPatch patch;
    double sum = 0.0;
    for (const Seen& cell : seen) {
        sum += pressure(cell);
        patch.center_G += pressure(cell) * cell.point_G;
    }
    patch.center_G /= sum;
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    double radius = 0.0;
    for (const Seen& cell : seen) {
        const Eigen::Vector3d off = cell.point_G - patch.center_G;
        variance += pressure(cell) * off.cwiseAbs2();
        radius += pressure(cell) * std::hypot(off.y(), off.z());
    }
    const double cell_y_m = 2.0 * face.half_width_m / config.lines_across;
    const double cell_z_m = (face.to_z_m - face.from_z_m) / config.lines_along;
    patch.half_width_m = half_extent_m(variance.y() / sum, cell_y_m);
    patch.half_height_m = half_extent_m(variance.z() / sum, cell_z_m);
    patch.mean_radius_m = std::hypot(radius / sum, 0.25 * std::min(cell_y_m, cell_z_m));
    patch.share = sum / (static_cast<double>(config.lines_across) * config.lines_along);
    return patch;
}

}  // namespace

Result<ContactPatches> contact_patches(const TriangleBvh& tree_W, const Eigen::Isometry3d& X_WG,
                                       const FingerFace& face, const ContactPatchConfig& config) {
    if (auto bad = validate(config, "contact_patch.")) return *bad;
    const auto left = look(tree_W, X_WG, face, config, -1.0);
    const auto right = look(tree_W, X_WG, face, config, 1.0);
    if (!left || !right) return PlanError{PlanErrorCode::kDegenerate, "a finger begins inside"};
    if (left->empty() || right->empty()) {
        return PlanError{PlanErrorCode::kDegenerate, "a finger meets nothing"};
    }
    return ContactPatches{press(*left, face, config), press(*right, face, config)};
}

}  // namespace graspd
