#pragma once

#include <span>
#include <string>

#include "graspd/planner/plan_types.hpp"
#include "write_json.hpp"

namespace graspd::cli {

/// A reply for people: a headline, the grasps in aligned columns (millimetres, degrees), what the
/// stages did and took (milliseconds), and, when there is no grasp, how many candidates fell by
/// each reason, the nearest misses and the suggestion.
std::string write_table(const PlanReply& reply, std::span<const Gripper> grippers,
                        const ResultOrigin& origin);

/// The grippers' dimensions in millimetres.
std::string write_table(std::span<const Gripper> grippers);

}  // namespace graspd::cli
