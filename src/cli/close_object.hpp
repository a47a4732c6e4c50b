#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd::cli {

/// The closed surface that the planner makes of an object too, and where its records went.
struct ClosedObject {
    ConditionedMesh solid;
    std::vector<std::int32_t> vertex_of_record;  ///< per vertex or point as stored: vertex of the
                                                 ///< solid, or -1
    double spacing_m = 0.0;                      ///< [m] of a cloud's points; 0 for a mesh
};

/// Triangulates a cloud, closes the surface and turns it to the sensor.
/// @param findings  what was found is added, also when it ends in an error
/// @return the first error of these stages
Result<ClosedObject> close_object(const std::variant<TriangleMesh, PointCloud>& object,
                                  const PlannerConfig& config, std::vector<Finding>& findings);

}  // namespace graspd::cli
