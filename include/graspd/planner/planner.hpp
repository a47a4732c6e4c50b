#pragma once

#include "graspd/base/stop.hpp"
#include "graspd/planner/plan_trace.hpp"
#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/planner_config.hpp"
#include "graspd/planner/prepared_object.hpp"

namespace graspd {

/// The key under which an object's geometry is known: content_key() of its points, faces and sensor
/// origin as received, 32 hexadecimal digits.
std::string object_key_of(const std::variant<TriangleMesh, PointCloud>& object_O);

/// The mass that plan() takes an object of this volume for [kg]: the request's, else that of
/// 500 kg/m3 within [0.02, 0.5].
double object_mass_kg(const PlanOptions& options, double volume_m3);

/// Plans grasps for one object: the paper from II-A to II-F. Without a grasp, or where the request
/// wants a suggestion, it plans again within other limits to say what would help; the object is
/// prepared once. Told to stop, which every stage asks many times, it answers PARTIAL with its last
/// completed round and the name of the stage that was under way.
///
/// Never throws for what an input can cause: every outcome is a status with a message. Pure apart
/// from the stages' wall times in the report, so safe to call from any number of threads; the same
/// request and configuration give the same reply whatever runs beside it.
/// @param trace  filled with what the plan saw on its way, for reports; the reply is the same
///               without. Null: nothing is kept
PlanReply plan(const PlanRequest& request, const PlannerConfig& config,
               const StopQuery& stop_requested = {}, PlanTrace* trace = nullptr);

/// The same for an object that may have been prepared before. The reply is that of the plan above
/// to the last bit, but that stages whose work was done before report the counts of that work and
/// 0 ms.
///
/// @param object  in: request.object_O as prepare() or an earlier plan made it, and then
///                request.object_O itself is not looked at; or null: it is prepared. Out: the
///                prepared object for later plans; null where it could not be prepared, or the
///                request was refused before. One that was prepared under other settings of the
///                stages before the search is refused as kInvalidRequest.
PlanReply plan(const PlanRequest& request, PreparedObjectPtr& object, const PlannerConfig& config,
               const StopQuery& stop_requested = {}, PlanTrace* trace = nullptr);

}  // namespace graspd
