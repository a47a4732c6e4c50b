#include "received_request.hpp"

#include "guid_bytes.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

}  // namespace

void ReceivedRequest::complete(const eprosima::fastdds::dds::SampleInfo& info) {
    received_ = std::chrono::steady_clock::now();
    identity_.writer = bytes_of(info.sample_identity.writer_guid());
    identity_.client_id = printable(sample.client_id());
    identity_.request_id = printable(sample.request_id());
    identity_.payload_hash = sample.payload_hash;
}

// The reply's message has one member, so its bytes are those of a RankedGrasps_.
bool write_service_reply(const ServiceCall& call, const wire::RankedGrasps_& reply,
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

std::unique_ptr<ReceivedRequest> read_service_call(Bytes payload,
                                                   const eprosima::fastdds::dds::SampleInfo& info,
                                                   bool keep_payload) {
    static const CdrStruct* const layout =
        wire_layouts().find("graspd_msgs::srv::dds_::PlanGrasps_Request_");
    auto request = std::make_unique<ReceivedRequest>();
    std::span<std::uint8_t> members = payload;
    ServiceCall& call = request->call.emplace();
    std::int64_t number = 0;
    if (info.related_sample_identity.writer_guid() != GUID_t::unknown()) {
        call.related.emplace();
        call.related->writer_guid(info.related_sample_identity.writer_guid());
        call.related->sequence_number(info.sample_identity.sequence_number());
        number = static_cast<std::int64_t>(info.sample_identity.sequence_number().to64long());
    } else {
        const auto header = take_service_header(members);
        if (!header) return nullptr;
        call.header = *header;
        number = header->sequence;
    }
    // The request's message has one member, so its bytes are those of a GraspRequest_.
    if (layout == nullptr || !is_well_formed(members, *layout)) return nullptr;
    try {
        if (keep_payload) {
            request->sample.payload = std::make_shared<ReceivedPayload>();
            request->sample.payload->by_service = true;
        }
        request->sample.read(members);
    } catch (...) {  // fastcdr's exceptions, bad_alloc
        return nullptr;
    }
    if (request->sample.request_id().empty()) {
        request->sample.request_id("call-" + std::to_string(number));
    }
    request->complete(info);
    return request;
}

}  // namespace graspd::dds
