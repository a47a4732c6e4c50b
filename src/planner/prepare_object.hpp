#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graspd/collision/gripper_collision.hpp"
#include "graspd/concavity/outer_hull.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/planner/planner_config.hpp"
#include "graspd/planner/prepared_object.hpp"
#include "stage_log.hpp"

namespace graspd {

/// The object as all later stages see it: closed, in its principal frame P, with its concavity.
/// Nothing here depends on the gripper.
struct PreparedObject {
    std::string object_key;
    std::string settings;             ///< settings_of_preparation() that it was prepared under
    std::vector<StageReport> stages;  ///< of its preparation, without their times
    TriangleMesh mesh_P;              ///< [m]
    Eigen::Isometry3d X_OP = Eigen::Isometry3d::Identity();
    std::shared_ptr<const TriangleBvh> tree_P;  ///< over mesh_P
    OuterHull hull_P;
    ConcavityField field;                                        ///< per vertex of mesh_P
    Eigen::Vector3d size_m = Eigen::Vector3d::Zero();            ///< [m] along the axes of P
    double volume_m3 = 0.0;                                      ///< [m^3]
    Eigen::Vector3d center_of_mass_P = Eigen::Vector3d::Zero();  ///< [m] uniform density
    std::vector<Finding> findings;
};

}  // namespace graspd

namespace graspd::planner_detail {

/// The settings that a prepared object depends on, as bytes to compare.
std::string settings_of_preparation(const PlannerConfig& config);

/// Section II-A: from a cloud or a mesh as received to its concavity.
/// @return the object, its key left to the caller; or the first stage's error: `log` has what was
/// done until then
Result<PreparedObject> prepare_object(const std::variant<TriangleMesh, PointCloud>& object_O,
                                      const PlannerConfig& config, StageLog& log);

/// A request's surroundings with their trees, in one frame. Not movable: the world points inside.
class Surroundings {
public:
    /// @param X_WF  pose of the request's frame F in the wanted frame W
    Surroundings(const PlanRequest& request, const PreparedObject& object,
                 const Eigen::Isometry3d& X_WF);
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;

    const CollisionWorld& world() const { return world_; }

private:
    struct Body {
        TriangleMesh mesh;
        std::unique_ptr<TriangleBvh> tree;
    };
    std::vector<Body> bodies_;
    CollisionWorld world_;
};

}  // namespace graspd::planner_detail
