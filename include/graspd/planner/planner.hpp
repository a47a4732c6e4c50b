#pragma once

#include "graspd/base/stop.hpp"
#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd {

/// The key under which an object's geometry is known: a hash of its points and faces as received.
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
PlanReply plan(const PlanRequest& request, const PlannerConfig& config,
               const StopQuery& stop_requested = {});

}  // namespace graspd
