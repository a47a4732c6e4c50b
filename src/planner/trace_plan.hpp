#pragma once

#include <vector>

#include "answer.hpp"
#include "find_concavities.hpp"
#include "graspd/planner/plan_trace.hpp"
#include "prepare_object.hpp"

namespace graspd::planner_detail {

/// The object's part of a trace.
/// @param center_of_mass_P  [m] as the plan uses it
void trace_object(const Eigen::Isometry3d& X_FP, const PreparedObject& object,
                  const Eigen::Vector3d& center_of_mass_P, PlanTrace& trace);

/// The search's part of a trace.
/// @param seen   by the request's grippers, those that were searched for
/// @param found  with a trace of its candidates
void trace_search(const PlanRequest& request, const std::vector<SeenSurface>& seen,
                  const Found& found, PlanTrace& trace);

}  // namespace graspd::planner_detail
