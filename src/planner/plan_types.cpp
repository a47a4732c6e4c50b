#include "graspd/planner/plan_types.hpp"

namespace graspd {

const char* to_string(PlanStatus status) {
    switch (status) {
        case PlanStatus::kOk: return "OK";
        case PlanStatus::kNoGrasp: return "NO_GRASP";
        case PlanStatus::kPartial: return "PARTIAL";
        case PlanStatus::kInvalidRequest: return "INVALID_REQUEST";
        case PlanStatus::kUnknownObject: return "UNKNOWN_OBJECT";
        case PlanStatus::kUnknownGripper: return "UNKNOWN_GRIPPER";
        case PlanStatus::kOverloaded: return "OVERLOADED";
        case PlanStatus::kCancelled: return "CANCELLED";
        case PlanStatus::kInternalError: return "INTERNAL_ERROR";
    }
    return "UNKNOWN";
}

PlanStatus status_of(PlanErrorCode code) {
    switch (code) {
        case PlanErrorCode::kUnknownGripper: return PlanStatus::kUnknownGripper;
        case PlanErrorCode::kUnknownObject: return PlanStatus::kUnknownObject;
        case PlanErrorCode::kInternal:
        case PlanErrorCode::kNoReply: return PlanStatus::kInternalError;
        case PlanErrorCode::kInvalidInput:
        case PlanErrorCode::kDegenerate:
        case PlanErrorCode::kTooLarge:
        case PlanErrorCode::kUnsupported:
        case PlanErrorCode::kUnreadableFile: return PlanStatus::kInvalidRequest;
    }
    return PlanStatus::kInternalError;
}

const char* to_string(GraspSource source) {
    switch (source) {
        case kBoundary: return "boundary";
        case kWall: return "wall";
        case kWholeObject: return "whole_object";
        case kAllSources: return "all";
        case kCandidate: return "candidate";
    }
    return "unknown";
}

}  // namespace graspd
