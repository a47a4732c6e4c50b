#pragma once

#include <span>
#include <string>

#include "convert_basics.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::dds {

/// Checks every field of a request and converts it. Mesh indices and coordinates, and the
/// coordinates of a cloud, are left to the planner's own checks. With an object_key the object is
/// left empty.
///
/// @param known  the grippers that a request may name
/// @return kInvalidInput, kUnsupported or kUnknownGripper for the first wrong field, with its value
Result<PlanRequest> read_request(const wire::GraspRequest_& request,
                                 std::span<const Gripper> known);
/// The same with a mesh in place of that of the request.
Result<PlanRequest> read_request(const wire::GraspRequest_& request, const TriangleMesh& mesh_O,
                                 std::span<const Gripper> known);

/// The same request on the wire, grippers inline and the stamp zero.
/// @return kInvalidInput for an id that the wire cannot carry, kTooLarge for a cloud too big
Result<wire::GraspRequest_> write_request(const PlanRequest& request, const std::string& client_id);

}  // namespace graspd::dds
