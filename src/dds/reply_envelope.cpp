#include "reply_envelope.hpp"

#include "moveit_service.hpp"
#include "received_request.hpp"

namespace graspd::dds {

std_msgs::msg::dds_::Header_ header_of(const IncomingRequest& to) {
    std_msgs::msg::dds_::Header_ header;
    if (const auto* request = dynamic_cast<const ReceivedRequest*>(&to)) {
        header.stamp(request->sample.header().stamp());
    } else if (const auto* call = dynamic_cast<const MoveItRequest*>(&to)) {
        header.stamp(call->sample.target().header().stamp());
    }
    header.frame_id(to.frame_id());
    return header;
}

ReplyEnvelope envelope_of(const OutgoingReply& reply, const DdsSettings& settings) {
    ReplyEnvelope out;
    out.header = header_of(*reply.to);
    out.request_writer = reply.to->identity().writer;
    out.client_id = reply.to->identity().client_id;
    out.request_id = reply.to->identity().request_id;
    out.attempt = reply.attempt;
    out.planner_id = settings.planner_id;
    out.planner_version = settings.version;
    out.config_hash = settings.config_hash;
    return out;
}

}  // namespace graspd::dds
