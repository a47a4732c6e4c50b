#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/triangle_bvh.hpp"

namespace graspd {

/// How densely the pads' footprint is probed, and how deep a pad feels.
struct LocalCloudConfig {
    std::uint32_t lines_across = 9;  ///< along Gy, over the pad's width
    std::uint32_t lines_along = 5;   ///< along Gz, over the pad's height
    double max_depth_m = 0.0015;     ///< [m] a place this far behind the first touch still counts

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("lines_across", self.lines_across, 2u, 100u);
        visit("lines_along", self.lines_along, 1u, 100u);
        visit("max_depth_m", self.max_depth_m, 1e-5, 0.05);
    }
};

/// The rectangle in which a pad can touch, and the stretch of Gx that is looked at.
struct PadFootprint {
    double half_width_m = 0.01;   ///< [m] along Gy
    double half_height_m = 0.01;  ///< [m] along Gz, about the TCP
    double half_reach_m = 0.05;   ///< [m] along Gx, to both sides of the TCP
};

/// Where one closing pad meets the object.
struct PadTouch {
    double x_G = 0.0;                                    ///< [m] of the first touch
    Eigen::Vector3d point_G = Eigen::Vector3d::Zero();   ///< [m] mean of the touched places
    Eigen::Vector3d normal_G = Eigen::Vector3d::Zero();  ///< their mean outward normal, unit
    double share = 0.0;  ///< [1] of the footprint that touches within max_depth_m
};

/// What lies between the pads of one candidate.
struct LocalCloud {
    std::vector<Eigen::Vector3d> points_G;  ///< [m] the first places seen from -Gx and from +Gx
    PadTouch left, right;                   ///< the pads at -Gx and +Gx
    double line_spacing_m = 0.0;            ///< [m] distance of neighbouring lines along Gy
};

/// Extracts a candidate's local cloud and the places where its pads touch.
///
/// Source: Lei & Wisse 2016, Sec. II-E, Fig. 17.
/// Deviation: the extent is open in the paper. Ours: the pads' footprint between the open fingers;
/// and the cloud is taken by lines along the closing axis, which see exactly what a closing pad
/// meets, whatever the mesh's or the samples' density.
///
/// @param object_W   mesh and tree of the object [m]
/// @param X_WG       tentative grasp frame
/// @return the cloud; kDegenerate when one of the pads meets nothing, or begins inside the object;
///         kInvalidInput for a parameter out of range
/// Complexity O(lines log F). Pure, so safe to call from any thread.
Result<LocalCloud> local_cloud(const TriangleMesh& object_W, const TriangleBvh& tree_W,
                               const Eigen::Isometry3d& X_WG, const PadFootprint& footprint,
                               const LocalCloudConfig& config);

}  // namespace graspd
