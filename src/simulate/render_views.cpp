#include "graspd/simulate/render_views.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "offscreen.hpp"
#include "picture_scene.hpp"

namespace graspd {
namespace {

using simulate_detail::Drawing;
using simulate_detail::Stage;

/// Blue, cyan, green, yellow, red: the paper's Fig. 3f, the colours of the report page.
Drawing::Texels scale_texels() {
    constexpr std::array<std::array<double, 3>, 5> kStops = {{{0.16, 0.30, 0.75},
                                                              {0.15, 0.62, 0.75},
                                                              {0.35, 0.75, 0.35},
                                                              {0.95, 0.80, 0.25},
                                                              {0.85, 0.15, 0.12}}};
    Drawing::Texels texels{};
    for (std::size_t i = 0; i < Drawing::kTexels; ++i) {
        const double place = 4.0 * static_cast<double>(i) / (Drawing::kTexels - 1);
        const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(place), 3);
        for (std::size_t k = 0; k < 3; ++k) {
            const double colour =
                std::lerp(kStops[low][k], kStops[low + 1][k], place - static_cast<double>(low));
            texels[3 * i + k] = static_cast<mjtByte>(std::lround(255.0 * colour));
        }
    }
    return texels;
}

/// From the middle of the first texel to that of the last, so that the ends do not mix.
std::vector<double> texture_places(const std::vector<double>& shares) {
    std::vector<double> places;
    places.reserve(shares.size());
    for (const double share : shares) {
        const double within = share >= 0.0 ? std::min(share, 1.0) : 0.0;  // also NaN
        places.push_back((0.5 + within * (Drawing::kTexels - 1)) / Drawing::kTexels);
    }
    return places;
}

std::vector<mjvGeom> geoms_of(const std::vector<PictureDot>& dots, const Eigen::Isometry3d& X_WF,
                              double side_m) {
    const mjtNum size[] = {0.5 * side_m, 0.5 * side_m, 0.5 * side_m};
    const mjtNum upright[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    std::vector<mjvGeom> geoms;
    for (const PictureDot& dot : dots) {
        if (std::ssize(geoms) == Drawing::kMostDots) break;
        const Eigen::Vector3d place = X_WF * dot.point_F;
        const float rgba[] = {dot.colour[0], dot.colour[1], dot.colour[2], 1.0F};
        mjv_initGeom(&geoms.emplace_back(), mjGEOM_BOX, size, place.data(), upright, rgba);
    }
    return geoms;
}

/// Which of the model's things are seen: the skin's texture, the hand's geoms.
class Wardrobe {
public:
    explicit Wardrobe(mjModel& model) : model_(model), material_(model.skin_matid[0]) {}
    void put_on(const SceneView& view) {
        model_.skin_matid[0] = view.by_share ? material_ : -1;
        for (int geom = model_.ngeom - kHandGeoms; geom < model_.ngeom; ++geom) {
            model_.geom_rgba[4 * geom + 3] = view.hand ? 1.0F : 0.0F;
        }
    }

private:
    static constexpr int kHandGeoms = 3;  // the last of the model

    mjModel& model_;
    int material_;
};

std::vector<Image> draw(const RestingScene& scene, const std::vector<SceneView>& views,
                        const RenderConfig& config) {
    SimulatedFrame frame;
    frame.X_FG = scene.X_FG;
    frame.opening_m = scene.width_m;
    const Stage stage(scene.gripper, scene.width_m, config.up_F);
    const Eigen::AlignedBox3d bounds = stage.bounds(frame, scene.mesh_F);
    const auto places = texture_places(scene.shares);
    const simulate_detail::OffscreenContext gl;
    Drawing drawing(
        simulate_detail::scene_text({scene.mesh_F, places, scene.gripper, scene.width_m},
                                    stage.parts(scene.width_m), bounds, config),
        scale_texels());
    drawing.aim(bounds, stage.view(frame));
    drawing.place(stage.poses(frame));
    Wardrobe wardrobe(*drawing.model);
    std::vector<Image> images;
    for (const SceneView& view : views) {
        wardrobe.put_on(view);
        const auto dots = geoms_of(view.dots, stage.X_WF(), scene.dot_m);
        images.push_back(drawing.picture(config, dots));
    }
    return images;
}

}  // namespace

Result<std::vector<Image>> render_views(const RestingScene& scene,
                                        const std::vector<SceneView>& views,
                                        const RenderConfig& config) {
    if (scene.shares.size() != scene.mesh_F.vertices.size()) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "render_views: " + std::to_string(scene.shares.size()) + " shares of " +
                             std::to_string(scene.mesh_F.vertices.size()) + " vertices"};
    }
    try {
        return draw(scene, views, config);
    } catch (const std::runtime_error& error) {
        return PlanError{PlanErrorCode::kUnsupported, error.what()};
    }
}

}  // namespace graspd
