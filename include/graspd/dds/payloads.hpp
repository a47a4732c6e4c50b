#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/dds/planner_port.hpp"

namespace graspd {

// Requests and replies as the bytes of their DDS samples: encapsulation header, then CDR of either
// byte order. For files of such bytes; nothing here joins a domain.

/// A request from its payload; its writer is zero, and it counts as received now.
/// @return kInvalidInput for bytes that are no GraspRequest
Result<std::unique_ptr<IncomingRequest>> read_request_payload(
    std::span<const std::uint8_t> payload);

/// A request as a client of that id would send it, grippers inline.
/// @return kInvalidInput for an id that the wire cannot carry, kTooLarge for a cloud too big
Result<std::vector<std::uint8_t>> request_payload(const PlanRequest& request,
                                                  const std::string& client_id);

/// A reply from its payload. @return kInvalidInput for bytes that are no RankedGrasps
Result<PlanReply> read_reply_payload(std::span<const std::uint8_t> payload);

/// A reply without what is not the plan's: stamp, writer and client are zero or empty.
std::vector<std::uint8_t> reply_payload(const PlanReply& reply);

}  // namespace graspd
