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
        {"/diagnostics", &names.diagnostics}};
    for (const auto& [name, to] : topics) {
        const auto resolved = resolve_name(ros, name, RosNameKind::kTopic);
        if (!resolved.ok()) return resolved.error();
        *to = dds_topic_name(resolved.value(), DdsTopicKind::kTopic);
    }
    const auto service = resolve_name(ros, "graspd/plan_grasps", RosNameKind::kService);
    if (!service.ok()) return service.error();
    names.service_request = dds_topic_name(service.value(), DdsTopicKind::kServiceRequest);
    names.service_reply = dds_topic_name(service.value(), DdsTopicKind::kServiceReply);
    return names;
}

}  // namespace graspd
