#include <algorithm>
#include <cmath>
#include <utility>

#include "graspd/base/gripper.hpp"

namespace graspd {
namespace {

/// Pose of G's axes in H, its origin left at H's.
Eigen::Isometry3d axes_in_hand(const Gripper& gripper) {
    Eigen::Isometry3d X_HG = grasp_in_hand(gripper, gripper.max_width_m);
    X_HG.translation().setZero();
    return X_HG;
}

/// Points of every part in H at an opening.
std::vector<std::vector<Eigen::Vector3d>> points_in_hand(const Gripper& gripper, double opening_m) {
    std::vector<Eigen::Isometry3d> links;
    if (gripper.linkage) {
        links = link_poses_H(*gripper.linkage, driver_position(*gripper.linkage, opening_m));
    }
    const double forth_m = pad_z_m(gripper, opening_m) - pad_z_m(gripper, gripper.max_width_m);
    const Eigen::Vector3d inward_H =
        0.5 * (gripper.max_width_m - opening_m) * axes_in_hand(gripper).linear().col(0);
    std::vector<std::vector<Eigen::Vector3d>> parts;
    parts.reserve(gripper.convex_parts.size());
    for (const ConvexPart& part : gripper.convex_parts) {
        Eigen::Isometry3d X_HL = Eigen::Isometry3d::Identity();
        if (part.joint >= 0) {
            X_HL = links[static_cast<std::size_t>(part.joint)];
        } else if (!gripper.linkage && part.member != GripperMember::kPalm) {
            const double side = part.member == GripperMember::kFingerLeft ? 1.0 : -1.0;
            X_HL.translation() = side * inward_H + forth_m * Eigen::Vector3d::UnitZ();
        }
        auto& points = parts.emplace_back();
        points.reserve(part.points.size());
        for (const Eigen::Vector3d& point : part.points) points.push_back(X_HL * point);
    }
    return parts;
}

/// Grows with what it is shown at one opening.
struct Extent {
    Eigen::AlignedBox3d palm;    ///< in H, along G's axes
    Eigen::AlignedBox3d finger;  ///< x outward from the pad's plane, z from its middle
};

Extent extent_of(const Gripper& gripper, Extent extent, double opening_m) {
    const auto parts = points_in_hand(gripper, opening_m);
    const Eigen::Isometry3d X_GH = axes_in_hand(gripper).inverse();
    const double pad_z = pad_z_m(gripper, opening_m);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const GripperMember member = gripper.convex_parts[i].member;
        const double side = member == GripperMember::kFingerLeft ? -1.0 : 1.0;
        for (const Eigen::Vector3d& point_H : parts[i]) {
            const Eigen::Vector3d p = X_GH * point_H;
            if (member == GripperMember::kPalm) {
                extent.palm.extend(p);
            } else {
                extent.finger.extend(
                    Eigen::Vector3d(side * p.x() - 0.5 * opening_m, p.y(), p.z() - pad_z));
            }
        }
    }
    return extent;
}

double widest(const Eigen::AlignedBox3d& box, Eigen::Index axis) {
    return 2.0 * std::max(std::abs(box.min()[axis]), std::abs(box.max()[axis]));
}

}  // namespace

Eigen::Vector2d pad_half_size_m(const Gripper& gripper) {
    return {0.5 * (gripper.pad_width_m > 0.0 ? gripper.pad_width_m : gripper.finger_width_m),
            gripper.pad_height_m > 0.0 ? 0.5 * gripper.pad_height_m : gripper.tip_offset_m};
}

std::vector<PlacedPart> placed_parts(const Gripper& gripper, double contact_width_m,
                                     double opening_m) {
    std::vector<PlacedPart> placed;
    if (gripper.convex_parts.empty()) return placed;
    const Eigen::Isometry3d X_GH = grasp_in_hand(gripper, contact_width_m).inverse();
    auto parts = points_in_hand(gripper, opening_m);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (Eigen::Vector3d& point : parts[i]) point = X_GH * point;
        placed.push_back({gripper.convex_parts[i].member, std::move(parts[i])});
    }
    return placed;
}

void fit_boxes(Gripper& gripper) {
    constexpr int kSteps = 32;
    const Eigen::Vector2d pad = 2.0 * pad_half_size_m(gripper);
    gripper.pad_width_m = pad.x();
    gripper.pad_height_m = pad.y();
    if (gripper.pad_travel.empty()) {  // else the boxes' new sizes would shift the pads
        gripper.pad_travel = {{gripper.max_width_m, pad_z_m(gripper, gripper.max_width_m)}};
    }
    Extent extent;
    for (int i = 0; i <= kSteps; ++i) {
        const double share = static_cast<double>(i) / kSteps;
        extent =
            extent_of(gripper, extent,
                      gripper.min_width_m + share * (gripper.max_width_m - gripper.min_width_m));
    }
    if (!extent.palm.isEmpty()) {
        gripper.palm_width_m = widest(extent.palm, 0);
        gripper.palm_height_m = widest(extent.palm, 1);
        gripper.palm_z_m = extent.palm.min().z();
        gripper.palm_depth_m = extent.palm.sizes().z();
    }
    if (extent.finger.isEmpty()) return;
    const double tip_m = std::max(extent.finger.max().z(), 0.5 * pad.y());
    gripper.finger_length_m = tip_m - std::min(extent.finger.min().z(), -0.5 * pad.y());
    gripper.tip_offset_m = tip_m;
    gripper.finger_width_m = std::max(widest(extent.finger, 1), pad.x());
    gripper.finger_thickness_m = extent.finger.max().x();
}

}  // namespace graspd
