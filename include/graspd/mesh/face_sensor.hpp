#pragma once

#include <optional>

#include <Eigen/Core>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/mesh/condition_mesh.hpp"

namespace graspd {

/// When a cloud's surface counts as seen from one side, and what is assumed behind it.
struct FaceSensorConfig {
    double one_sided_from = 0.25;  ///< [1] |sum of area x normal| over the area seen: 0 all round,
                                   ///< 1/5 a box without its bottom, 1/2 half a sphere, 1 a plane
    double back_thickness = 0.02;  ///< [1] of the diagonal: of the shell behind a hollow that faces
                                   ///< the sensor

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("one_sided_from", self.one_sided_from, 0.01, 1.0);
        visit("back_thickness", self.back_thickness, 1e-3, 0.2);
    }
};

/// Says whether a cloud's closed surface was seen from one side only, and makes what was seen face
/// the sensor.
///
/// condition_mesh() closes an open surface over its rim and turns it outward by its volume. That
/// is right for what bulges towards the sensor: the rest is closed flat behind it. A hollow that
/// faces the sensor, such as a bowl seen from above, comes out inside out: then a shell of
/// back_thickness behind what was seen, away from the sensor, stands for it instead.
///
/// Source: none in the paper, whose clouds are merged views.
/// @param closed  of the cloud's triangles; vertex_of_input is carried over
/// @param sensor_origin  [m] where the sensor stood, same frame; absent: nothing is turned
/// @return the surface with, when it is one-sided, the finding one_sided (value: area that was seen
///         over the area that is planned on) and the findings of the shell; condition_mesh's errors
/// Complexity O(F). Pure.
Result<ConditionedMesh> face_sensor(ConditionedMesh closed,
                                    const std::optional<Eigen::Vector3d>& sensor_origin,
                                    const ConditionMeshConfig& condition,
                                    const FaceSensorConfig& config);

}  // namespace graspd
