#pragma once

#include <array>
#include <memory>

#include <Eigen/Geometry>

#include "graspd/base/geometry.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/simulate/simulate_grasp.hpp"
#include "solid.hpp"

namespace graspd::simulate_detail {

/// What the scene is made of.
struct SceneParts {
    const TriangleMesh* mesh_F = nullptr;  ///< [m] copied
    Solid solid;                           ///< of it
    Gripper gripper;
    Eigen::Isometry3d X_FG = Eigen::Isometry3d::Identity();  ///< where the fingers begin to squeeze
    double contact_width_m = 0.0;                            ///< [m] that G belongs to
    double opening_m = 0.0;                                  ///< [m] gap that they begin with
};

/// Hand and object in MuJoCo. The hand's base follows the path that it is told; its fingers are a
/// coupled pair of slides along Gx with a force on each; the object is free. There is no gravity:
/// weight is a force like others.
///
/// Only one may exist at a time. Throws std::runtime_error where MuJoCo gives up.
class HandScene {
public:
    HandScene(const SceneParts& parts, const SimulationConfig& config);
    ~HandScene();
    HandScene(const HandScene&) = delete;
    HandScene& operator=(const HandScene&) = delete;

    void set_grip_force(double force_N);
    /// @param rate_1_s  [1/s] at which the object's motion dies away
    void set_object_damping(double rate_1_s);
    void set_weight(const Eigen::Vector3d& force_N_F);

    /// One time step, in which the base moves from where it is to X_FG.
    void step_to(const Eigen::Isometry3d& X_FG);

    const Eigen::Isometry3d& X_FG() const { return X_FG_; }
    Eigen::Isometry3d X_FO() const;  ///< of the object, from where it was at the beginning
    double opening_m() const;
    /// Whether palm, left and right finger touch the object.
    std::array<bool, 3> touching() const;

private:
    struct Physics;
    std::unique_ptr<Physics> physics_;
    Eigen::Isometry3d X_FG_;
};

}  // namespace graspd::simulate_detail
