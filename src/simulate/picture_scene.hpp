#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "graspd/simulate/render_frames.hpp"

namespace graspd::simulate_detail {

/// What there is to draw: the object at the beginning, and the hand.
struct PictureScene {
    const TriangleMesh& mesh_F;  ///< [m]
    const std::vector<double>&
        shares;  ///< per vertex, in [0, 1]: place in the texture; may be empty
    const Gripper& gripper;
    double contact_width_m = 0.0;
};

/// Poses of the object and the hand's boxes in W, whose z is up.
class Stage {
public:
    Stage(const Gripper& gripper, double contact_width_m, const Eigen::Vector3d& up_F);

    const Eigen::Isometry3d& X_WF() const { return X_WF_; }
    std::vector<GripperPart> parts(double opening_m) const {
        return gripper_parts(gripper_, contact_width_m_, opening_m);
    }
    /// Of the four mocap bodies: the object, then palm, left and right finger.
    std::array<Eigen::Isometry3d, 4> poses(const SimulatedFrame& frame) const;
    Eigen::AlignedBox3d bounds(const SimulatedFrame& frame, const TriangleMesh& mesh_F) const;
    /// Horizontal, along Gy and a little aside, so that both fingers are seen.
    Eigen::Vector3d view(const SimulatedFrame& frame) const;

private:
    const Gripper& gripper_;
    double contact_width_m_;
    Eigen::Isometry3d X_WF_ = Eigen::Isometry3d::Identity();
};

/// MuJoCo's model and drawing state of a scene; frees what MuJoCo allocates. There must be a
/// current OpenGL context. Throws std::runtime_error.
struct Drawing {
    static constexpr int kTexels = 256;  ///< of the texture that `shares` are places in
    using Texels = std::array<mjtByte, std::size_t{3} * kTexels>;  ///< red, green, blue of each
    static constexpr int kMostDots = 30000;

    mjModel* model = nullptr;
    mjData* data = nullptr;
    mjvScene scene{};
    mjvOption option{};
    mjvCamera camera{};
    mjrContext context{};

    Drawing(const std::string& scene_text, const Texels& texels);
    ~Drawing();
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    void place(const std::array<Eigen::Isometry3d, 4>& poses);
    void aim(const Eigen::AlignedBox3d& bounds_W, const Eigen::Vector3d& forward_W);
    /// The scene as it is now, with further geoms (no more than kMostDots).
    Image picture(const RenderConfig& config, const std::vector<mjvGeom>& more = {});
};

/// The model as MuJoCo's XML: the object as a skin, palm and fingers, floor and light.
std::string scene_text(const PictureScene& scene, const std::vector<GripperPart>& parts,
                       const Eigen::AlignedBox3d& bounds_W, const RenderConfig& config);

}  // namespace graspd::simulate_detail
