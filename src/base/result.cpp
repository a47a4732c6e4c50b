#include "graspd/base/result.hpp"

namespace graspd {

const char* to_string(PlanErrorCode code) {
    switch (code) {
        case PlanErrorCode::kInvalidInput: return "invalid_input";
        case PlanErrorCode::kDegenerate: return "degenerate";
        case PlanErrorCode::kTooLarge: return "too_large";
        case PlanErrorCode::kUnsupported: return "unsupported";
        case PlanErrorCode::kUnknownGripper: return "unknown_gripper";
        case PlanErrorCode::kUnknownObject: return "unknown_object";
        case PlanErrorCode::kUnreadableFile: return "unreadable_file";
        case PlanErrorCode::kNoReply: return "no_reply";
        case PlanErrorCode::kInternal: return "internal";
    }
    return "unknown";
}

}  // namespace graspd
