#include "exit_code.hpp"

namespace graspd::cli {

int exit_code(const PlanReply& reply) {
    switch (reply.status) {
        case PlanStatus::kOk: return kExitOk;
        case PlanStatus::kPartial: return reply.grasps.empty() ? kExitNoGrasp : kExitOk;
        case PlanStatus::kNoGrasp: return kExitNoGrasp;
        case PlanStatus::kInvalidRequest:
        case PlanStatus::kUnknownObject:
        case PlanStatus::kUnknownGripper: return kExitUsage;
        case PlanStatus::kOverloaded:
        case PlanStatus::kCancelled: return kExitNoReply;
        case PlanStatus::kInternalError: return kExitInternal;
    }
    return kExitInternal;
}

int exit_code(const PlanError& error) {
    if (error.code == PlanErrorCode::kNoReply) return kExitNoReply;
    return error.code == PlanErrorCode::kInternal ? kExitInternal : kExitUsage;
}

}  // namespace graspd::cli
