#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "cdr_bytes.hpp"
#include "convert_request.hpp"
#include "graspd/dds/planner_port.hpp"
#include "received_sample.hpp"

namespace graspd::dds {

/// How the answer to a service call finds its caller.
struct ServiceCall {
    /// rmw_fastrtps: the caller's reply reader, and its number of the request; goes back as the
    /// reply's related sample. Else rmw_cyclonedds.
    std::optional<eprosima::fastrtps::rtps::SampleIdentity> related;
    ServiceHeader header;  ///< of rmw_cyclonedds; goes back before the reply's members
};

/// One request that came in, by the topic or by the service.
class ReceivedRequest final : public IncomingRequest {
public:
    /// To be filled by the middleware; complete() must follow.
    ReceivedSample sample;
    std::optional<ServiceCall> call;  ///< absent: by the topic

    void complete(const eprosima::fastdds::dds::SampleInfo& info);

    const RequestIdentity& identity() const override { return identity_; }
    std::chrono::steady_clock::time_point received() const override { return received_; }
    const std::string& frame_id() const override { return sample.header().frame_id(); }
    const std::string& object_key() const override { return sample.object_key(); }
    std::shared_ptr<const ReceivedPayload> payload() const override { return sample.payload; }
    Result<PlanRequest> convert(std::span<const Gripper> known) const override {
        return read_request(sample, sample.mesh_O, known);
    }

private:
    RequestIdentity identity_;
    std::chrono::steady_clock::time_point received_;
};

/// Writes the reply to a service call in the way that its caller understands.
/// @return false: not written
bool write_service_reply(const ServiceCall& call, const wire::RankedGrasps_& reply,
                         eprosima::fastdds::dds::DataWriter& writer);

/// Reads a service call, whichever ROS 2 vendor it comes from: rmw_fastrtps names a related sample
/// and writes the members alone, rmw_cyclonedds names none and puts a header before them. A call
/// without a request_id gets one, "call-" with the call's number: the service itself tells replies
/// apart.
/// @return null for a malformed payload
std::unique_ptr<ReceivedRequest> read_service_call(Bytes payload,
                                                   const eprosima::fastdds::dds::SampleInfo& info,
                                                   bool keep_payload = false);

}  // namespace graspd::dds
