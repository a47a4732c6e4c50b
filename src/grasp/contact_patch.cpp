#include "graspd/grasp/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "closing_lines.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {
namespace {

using grasp_detail::LineHit;

std::vector<double> middles_of_cells(std::uint32_t count, double from, double to) {
    std::vector<double> middles;
    for (std::uint32_t i = 0; i < count; ++i) {
        middles.push_back(from + (to - from) * (i + 0.5) / count);
    }
    return middles;
}

/// The cell's own size counts: a patch of one cell is as wide as that.
double half_extent_m(double variance, double cell_m) {
    return std::sqrt(3.0 * variance + 0.25 * cell_m * cell_m);
}

ContactPatch press(const std::vector<LineHit>& seen, const FingerFace& face,
                   const ContactPatchConfig& config) {
    const double first_m = std::ranges::min(seen, {}, &LineHit::advance_m).advance_m;
    struct Pressed {
        double pressure;
        const LineHit* cell;
    };
    std::vector<Pressed> pressed;  // the others add nothing
    pressed.reserve(seen.size());
    for (const LineHit& cell : seen) {
        const double pressure = 1.0 - (cell.advance_m - first_m) / config.compression_m;
        if (pressure > 0.0) pressed.push_back({pressure, &cell});
    }
    ContactPatch patch;
    double sum = 0.0;
    for (const auto& [pressure, cell] : pressed) {
        sum += pressure;
        patch.center_G += pressure * cell->point_G;
    }
    patch.center_G /= sum;
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    double radius = 0.0;
    for (const auto& [pressure, cell] : pressed) {
        const Eigen::Vector3d off = cell->point_G - patch.center_G;
        variance += pressure * off.cwiseAbs2();
        radius += pressure * std::hypot(off.y(), off.z());
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
    const auto y_G = middles_of_cells(config.lines_across, -face.half_width_m, face.half_width_m);
    const auto z_G = middles_of_cells(config.lines_along, face.from_z_m, face.to_z_m);
    const auto lines = grasp_detail::closing_lines(tree_W, X_WG, y_G, z_G, face.half_reach_m);
    if (!lines) return lines.error();
    const auto& [left, right] = lines.value();
    if (left.empty() || right.empty()) {
        return PlanError{PlanErrorCode::kDegenerate, "a finger meets nothing"};
    }
    return ContactPatches{press(left, face, config), press(right, face, config)};
}

}  // namespace graspd
