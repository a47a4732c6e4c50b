#pragma once

#include <string>

namespace graspd {

/// The DDS topics of the planner, by default those of docs/interface.md; remapping changes them.
struct WireNames {
    std::string grasp_request = "rt/graspd/grasp_request";
    std::string ranked_grasps = "rt/graspd/ranked_grasps";
    std::string cancel = "rt/graspd/cancel";
    std::string status = "rt/graspd/status";
    std::string diagnostics = "rt/diagnostics";
    std::string markers = "rt/graspd/markers";
    std::string service_request = "rq/graspd/plan_graspsRequest";
    std::string service_reply = "rr/graspd/plan_graspsReply";
    std::string moveit_request = "rq/plan_graspsRequest";
    std::string moveit_reply = "rr/plan_graspsReply";
};

}  // namespace graspd
