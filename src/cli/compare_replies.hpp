#pragma once

#include <string>
#include <vector>

#include "graspd/planner/plan_types.hpp"

namespace graspd::cli {

/// One thing in which two replies differ.
struct ReplyDifference {
    std::string what;      ///< such as "status" or "grasp 2: position"
    std::string recorded;  ///< its value in the first reply
    std::string replayed;  ///< its value in the second
};

/// Everything in which two replies differ but the stages' times: verdict, grasps rank by rank,
/// report. Numbers count as equal to the last bit. Empty for equal replies.
std::vector<ReplyDifference> compare_replies(const PlanReply& recorded, const PlanReply& replayed);

}  // namespace graspd::cli
