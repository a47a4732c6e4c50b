#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "graspd/base/geometry.hpp"
#include "graspd/dds/planner_port.hpp"
#include "wire_types.hpp"

namespace graspd::dds {

struct PayloadGuard;

/// A request as it is taken from the wire. Its mesh goes to the planner's own type at once, in two
/// blocks: element by element, as the generated code reads it, 5 MB took 4 ms.
struct ReceivedSample : wire::GraspRequest_ {
    TriangleMesh mesh_O;             ///< [m] every vertex and face as it stands; mesh() is empty
    std::uint64_t payload_hash = 0;  ///< content_hash() of the payload
    /// Where there is one, the guarded read() leaves the bytes here; those of too large a payload
    /// it does not keep, and this becomes null.
    std::shared_ptr<ReceivedPayload> payload;

    std::chrono::steady_clock::time_point received;  ///< before it was read
    RequestSize size;
    std::optional<PlanError> refused;  ///< over a limit: nothing but its names was read then

    /// Counts, compares with the limits, then reads. @param bytes  with the encapsulation header;
    /// of a payload over the limit as many as hold the names are enough
    /// @param sent_bytes  as many as came
    /// @return false for a malformed payload, and for one over a limit whose names cannot be read
    bool read(std::span<std::uint8_t> bytes, std::uint64_t sent_bytes, const PayloadGuard& guard);
    bool read(std::span<std::uint8_t> bytes, const PayloadGuard& guard) {
        return read(bytes, bytes.size(), guard);
    }

    /// Reads everything from a payload that is_well_formed() has let through, of either byte order.
    /// Throws what fastcdr throws.
    void read(std::span<std::uint8_t> bytes);
};

}  // namespace graspd::dds
