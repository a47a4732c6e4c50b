#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "cdr_bytes.hpp"
#include "convert_options.hpp"
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

/// What the reply to a call bears. @return IncomingRequest::reply_key() of a call
std::string reply_key_of(const ServiceCall& call);

/// Which call the reply in a sample answers, whoever made it and by whichever ROS 2 vendor.
/// @return nothing for a payload that is too short
std::optional<ServiceCall> answered_call(std::span<const std::uint8_t> payload,
                                         const eprosima::fastdds::dds::SampleInfo& info);

/// One request that came in, by the topic or by the service.
class ReceivedRequest final : public IncomingRequest {
public:
    /// To be filled by the middleware; complete() must follow.
    ReceivedSample sample;
    std::optional<ServiceCall> call;  ///< absent: by the topic

    void complete(const eprosima::fastdds::dds::SampleInfo& info);

    const RequestIdentity& identity() const override { return identity_; }
    std::chrono::steady_clock::time_point received() const override { return sample.received; }
    const std::string& frame_id() const override { return sample.header().frame_id(); }
    const std::string& object_key() const override { return sample.object_key(); }
    std::string reply_key() const override {
        return call ? reply_key_of(*call) : topic_reply_key(identity_);
    }
    void take_over(std::chrono::steady_clock::time_point now) override { sample.received = now; }
    std::shared_ptr<const ReceivedPayload> payload() const override { return sample.payload; }
    Result<PlanRequest> convert(std::span<const Gripper> known) const override {
        if (sample.refused) return *sample.refused;
        return read_request(sample, sample.mesh_O, known);
    }
    double time_budget_s() const override { return asked_budget_s(sample); }
    RequestSize size() const override { return sample.size; }
    bool is_call() const override { return call.has_value(); }

private:
    RequestIdentity identity_;
};

/// A service call taken apart.
struct OpenedCall {
    ServiceCall call;
    std::int64_t number = 0;          ///< that the caller gave it
    std::span<std::uint8_t> members;  ///< a payload without header, within the call's
};

/// Tells which ROS 2 vendor a call comes from: rmw_fastrtps names a related sample and writes the
/// members alone, rmw_cyclonedds names none and puts a header before them.
/// @return nothing for a payload that is too short
std::optional<OpenedCall> open_service_call(std::span<std::uint8_t> payload,
                                            const eprosima::fastdds::dds::SampleInfo& info);

/// Writes the reply to a service call in the way that its caller understands. `Struct` has the
/// bytes of the service's response.
/// @return false: not written
template <class Struct>
bool write_service_reply(const ServiceCall& call, const Struct& reply,
                         eprosima::fastdds::dds::DataWriter& writer) {
    if (call.related) {
        Bytes payload = cdr_bytes(reply);
        eprosima::fastrtps::rtps::WriteParams parameters;
        parameters.related_sample_identity(*call.related);
        return writer.write(&payload, parameters);
    }
    Bytes payload = cdr_bytes(reply, call.header);
    return writer.write(&payload);
}

/// Reads a call of the planner's own service. A call without a request_id gets one, "call-" with
/// the call's number: the service itself tells replies apart.
/// @return null for a malformed payload
std::unique_ptr<ReceivedRequest> read_service_call(CallPayload payload,
                                                   const eprosima::fastdds::dds::SampleInfo& info,
                                                   const PayloadGuard& guard,
                                                   bool keep_payload = false);

}  // namespace graspd::dds
