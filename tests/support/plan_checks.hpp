#pragma once

#include "graspd/planner/plan_types.hpp"
#include "graspd/planner/planner_config.hpp"

namespace graspd::test {

/// A request for a mesh with parallel_85, all else default; the object lies in F as it is.
PlanRequest request_for(TriangleMesh mesh_O);

/// A solid of 70 x 40 x 50 mm that no turn and no mirror carries into itself: a plate with a boss
/// and a smaller one beside it. Every part is narrower than parallel_85 opens.
TriangleMesh lopsided(std::size_t faces);

/// Reports what is wrong with a reply to a request with parallel_85 alone, grasp by grasp: frames,
/// widths, contacts, friction, score, order, strategy; and the message.
void expect_consistent(const PlanReply& reply, const PlanRequest& request,
                       const PlannerConfig& config);

/// Reports when rejections and grasps do not add up, stage by stage, to what the stages were given:
/// every candidate is tried or counted, every pose of a tried one is returned or counted, each
/// once, by a reason of that stage. Not for stopped plans.
void expect_counts_add_up(const PlanReply& reply, const PlannerConfig& config);

/// Plans, and reports what is wrong by the two functions above.
PlanReply planned(const PlanRequest& request, const PlannerConfig& config = {});

/// Reports each difference in any field but the stages' times, to the last bit.
void expect_identical(const PlanReply& a, const PlanReply& b);

/// Count of a typed reason, 0 when it is missing.
std::uint64_t rejections_of(const PlanReply& reply, const std::string& reason);

/// What the reply tells of a stage; null when the stage is not in it.
const StageReport* stage_of(const PlanReply& reply, const std::string& name);

/// What came out of a stage, 0 when it is not in the reply.
std::uint64_t out_of(const PlanReply& reply, const std::string& stage);

}  // namespace graspd::test
