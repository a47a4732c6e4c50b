#pragma once

#include "graspd/planner/plan_types.hpp"

namespace graspd::test {

/// A request for a tetrahedron with parallel_85, all else default. Its numbers are binary
/// fractions.
PlanRequest small_request();
/// A request with every field set, none to its default. Poses turn by multiples of 90 degrees, so
/// that quaternions carry them to the last digit or two.
PlanRequest full_request();
/// A reply with every field set, two grasps and three near misses.
PlanReply full_reply();

/// Field for field, names and numbers equal, poses within 1e-15: reports each difference.
void expect_same(const PlanRequest& a, const PlanRequest& b);
void expect_same(const PlanReply& a, const PlanReply& b);

}  // namespace graspd::test
