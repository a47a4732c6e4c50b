#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "convert_basics.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::dds {

/// What a reply carries besides the plan: whose answer it is, and from whom.
struct ReplyEnvelope {
    std_msgs::msg::dds_::Header_ header;  ///< of the request
    std::array<std::uint8_t, 16> request_writer{};
    std::string client_id;   ///< of the request
    std::string request_id;  ///< of the request
    std::uint32_t attempt = 1;
    std::string planner_id;
    std::string planner_version;
    std::string config_hash;
};

/// The reply on the wire. Of the near misses the first three go along, as the type is bounded.
wire::RankedGrasps_ write_reply(const PlanReply& reply, const ReplyEnvelope& envelope);

/// A reply as the planner gave it. @return kInvalidInput for a status, source or convention that
/// this version does not know, or a pose that is none
Result<PlanReply> read_reply(const wire::RankedGrasps_& reply);

}  // namespace graspd::dds
