#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"
#include "graspd/simulate/render_frames.hpp"

namespace graspd {

/// A small cube on a picture.
struct PictureDot {
    Eigen::Vector3d point_F = Eigen::Vector3d::Zero();  ///< [m]
    std::array<float, 3> colour{};                      ///< red, green, blue in [0, 1]
};

/// An object at rest and the hand beside it.
struct RestingScene {
    TriangleMesh mesh_F;         ///< [m]
    std::vector<double> shares;  ///< per vertex, in [0, 1]: from blue to red; values beyond are cut
    Gripper gripper;
    double width_m = 0.0;                                    ///< [m] of the hand, which touches
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();  ///< the hand
    double dot_m = 0.002;                                    ///< [m] side of the dots
};

/// What one picture shows of it.
struct SceneView {
    bool by_share = false;  ///< the object by its shares, else grey
    bool hand = false;
    std::vector<PictureDot> dots;  ///< at most 30000; more are left out
};

/// Draws an object from one place in several ways, as render_frames() draws frames; the hand is in
/// view whether it is drawn or not.
/// @return one image a view; kInvalidInput for another number of shares than of vertices,
///         kUnsupported where there is no way to draw without a display
/// Not to be called from several threads at once.
Result<std::vector<Image>> render_views(const RestingScene& scene,
                                        const std::vector<SceneView>& views,
                                        const RenderConfig& config);

}  // namespace graspd
