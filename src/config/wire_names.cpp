#include "graspd/config/wire_names.hpp"

#include <utility>

namespace graspd {

Result<WireNames> wire_names(const RosArguments& ros) {
    WireNames names;
    const std::pair<const char*, std::string*> topics[] = {
        {"graspd/grasp_request", &names.grasp_request},
        {"graspd/ranked_grasps", &names.ranked_grasps},
        {"graspd/cancel", &names.cancel},
        {"graspd/status", &names.status},
        {"/diagnostics", &names.diagnostics},
        {"graspd/markers", &names.markers}};
    for (const auto& [name, to] : topics) {
        const auto resolved = resolve_name(ros, name, RosNameKind::kTopic);
        if (!resolved.ok()) return resolved.error();
        *to = dds_topic_name(resolved.value(), DdsTopicKind::kTopic);
    }
    struct Service {
        const char* name;
        std::string *request, *reply;
    };
    for (const auto& [name, request, reply] :
         {Service{"graspd/plan_grasps", &names.service_request, &names.service_reply},
          Service{"plan_grasps", &names.moveit_request, &names.moveit_reply}}) {
        const auto resolved = resolve_name(ros, name, RosNameKind::kService);
        if (!resolved.ok()) return resolved.error();
        *request = dds_topic_name(resolved.value(), DdsTopicKind::kServiceRequest);
        *reply = dds_topic_name(resolved.value(), DdsTopicKind::kServiceReply);
    }
    return names;
}

}  // namespace graspd
