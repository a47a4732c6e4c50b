#pragma once

#include "graspd/planner/plan_types.hpp"

namespace graspd::cli {

// What graspctl tells the shell (interface.md has the same table).
constexpr int kExitOk = 0;        ///< OK, or PARTIAL with grasps
constexpr int kExitInternal = 1;  ///< INTERNAL_ERROR, or the result could not be written
constexpr int kExitUsage = 2;     ///< wrong arguments or input, INVALID_REQUEST, UNKNOWN_*
constexpr int kExitNoGrasp = 3;   ///< NO_GRASP, or PARTIAL without grasps
constexpr int kExitNoReply = 4;   ///< no reply, OVERLOADED, CANCELLED

/// The exit code that a reply calls for.
int exit_code(const PlanReply& reply);

/// The exit code of an error that came before there was a reply.
int exit_code(const PlanError& error);

}  // namespace graspd::cli
