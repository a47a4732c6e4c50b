#include "graspd/simulate/render_frames.hpp"

#include <stdexcept>

#include "offscreen.hpp"
#include "picture_scene.hpp"

namespace graspd {
namespace {

using simulate_detail::Drawing;
using simulate_detail::Stage;

std::vector<Image> draw(const simulate_detail::PictureScene& scene, const Stage& stage,
                        const std::vector<SimulatedFrame>& frames, const RenderConfig& config) {
    Eigen::AlignedBox3d bounds;
    for (const SimulatedFrame& frame : frames) bounds.extend(stage.bounds(frame, scene.mesh_F));
    const simulate_detail::OffscreenContext gl;
    Drawing drawing(scene_text(scene, stage.parts(frames.front().opening_m), bounds, config), {});
    drawing.aim(bounds, stage.view(frames.front()));
    std::vector<Image> images;
    for (const SimulatedFrame& frame : frames) {
        drawing.place(stage.poses(frame));
        images.push_back(drawing.picture(config));
    }
    return images;
}

}  // namespace

Result<std::vector<Image>> render_frames(const TriangleMesh& mesh_F, const Gripper& gripper,
                                         double contact_width_m,
                                         const std::vector<SimulatedFrame>& frames,
                                         const RenderConfig& config) {
    if (frames.empty()) return std::vector<Image>{};
    try {
        return draw({mesh_F, {}, gripper, contact_width_m},
                    Stage(gripper, contact_width_m, config.up_F), frames, config);
    } catch (const std::runtime_error& error) {
        return PlanError{PlanErrorCode::kUnsupported, error.what()};
    }
}

}  // namespace graspd
