#pragma once

#include <cstdint>
#include <memory>
#include <variant>

#include "graspd/base/geometry.hpp"
#include "graspd/base/result.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd {

/// An object as every plan needs it, whatever gripper and surroundings: conditioned, in its
/// principal frame, with its hull, its tree for rays and its concavity (Sec. II-A). What is inside
/// is the planner's own. Immutable, so one may serve any number of plans at a time.
struct PreparedObject;
using PreparedObjectPtr = std::shared_ptr<const PreparedObject>;

/// Prepares an object for plan(). Takes a third of the time of a whole plan.
/// @param object_O  as in PlanRequest [m]
/// @return a bad setting, or the error of the first stage that fails: what plan() would refuse the
///         object for
Result<PreparedObjectPtr> prepare(const std::variant<TriangleMesh, PointCloud>& object_O,
                                  const PlannerConfig& config);

/// Memory that a prepared object takes with all that it owns [bytes]; the allocator's own
/// bookkeeping comes on top.
std::uint64_t memory_bytes(const PreparedObject& object);

}  // namespace graspd
