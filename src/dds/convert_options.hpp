#pragma once

#include "convert_basics.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::dds {

/// The options of a request; those of an absent PlanOptions are PlanOptions{}. Notes kInvalidInput
/// for a value outside its range and kUnsupported for a flag that nothing serves yet.
PlanOptions read_options(const wire::GraspRequest_& request, FirstError& errors);

wire::PlanOptions_ write_options(const PlanOptions& options);

/// The time budget that a request asks for [s]; the default where it asks for none or for what
/// read_options() refuses.
double asked_budget_s(const wire::GraspRequest_& request);

}  // namespace graspd::dds
