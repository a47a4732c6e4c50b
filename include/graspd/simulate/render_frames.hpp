#pragma once

#include <cstdint>
#include <vector>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/base/result.hpp"
#include "graspd/simulate/simulate_grasp.hpp"

namespace graspd {

/// A picture, row by row from the top, three bytes (red, green, blue) a pixel.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgb;  ///< width * height * 3
};

/// What the pictures look like.
struct RenderConfig {
    std::uint32_t width = 480;                        ///< [pixel]
    std::uint32_t height = 480;                       ///< [pixel]
    Eigen::Vector3d up_F = Eigen::Vector3d::UnitZ();  ///< unit, upwards in the picture
};

/// Draws recorded frames with MuJoCo's off-screen rendering; needs no display (EGL without a
/// surface, so a graphics driver or Mesa's software one).
///
/// A fixed camera looks across the closing direction and has the whole motion in view. The floor is
/// for the eye alone.
///
/// @param mesh_F           the object at the beginning [m]
/// @param contact_width_m  [m] width of the grasp, which G belongs to
/// @return one image a frame; kUnsupported where there is no way to draw without a display
/// Not to be called from several threads at once.
Result<std::vector<Image>> render_frames(const TriangleMesh& mesh_F, const Gripper& gripper,
                                         double contact_width_m,
                                         const std::vector<SimulatedFrame>& frames,
                                         const RenderConfig& config);

}  // namespace graspd
