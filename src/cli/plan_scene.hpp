#pragma once

#include <optional>

#include "graspd/planner/planner.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// A plan for one object of a scene.
struct ScenePlan {
    PlanRequest request;  ///< of that object, the others being obstacles
    PlanReply reply;      ///< with the finding scene_objects: how many there are, and where
};

/// Takes a request's cloud apart into a support plane and the objects on it, and plans for the one
/// nearest to a point, or for each: then the reply is that with the best grasp.
/// @param object_at_F  [m] chooses the object by its middle
/// @param trace  of the plan that is returned, as plan() takes it
/// @return kInvalidInput for a mesh; segment_scene's errors
Result<ScenePlan> plan_scene(const PlanRequest& request,
                             const std::optional<Eigen::Vector3d>& object_at_F,
                             const PlannerConfig& config, const StopQuery& stop_requested,
                             PlanTrace* trace = nullptr);

}  // namespace graspd::cli
