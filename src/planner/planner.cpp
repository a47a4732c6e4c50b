#include "graspd/planner/planner.hpp"

namespace graspd {

PlanReply plan(const PlanRequest& request, const PlannerConfig&, const StopQuery&) {
    PlanReply reply;
    reply.request_id = request.request_id;
    reply.frame_id = request.frame_id;
    return reply;
}

}  // namespace graspd
