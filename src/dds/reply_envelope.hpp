#pragma once

#include "convert_reply.hpp"
#include "graspd/dds/planner_port.hpp"

namespace graspd::dds {

/// F, and when the object was there: of the request, for its reply and its picture.
std_msgs::msg::dds_::Header_ header_of(const IncomingRequest& to);

/// What goes around a reply: whom it answers, and who answers.
ReplyEnvelope envelope_of(const OutgoingReply& reply, const DdsSettings& settings);

}  // namespace graspd::dds
