#include "received_request.hpp"

#include "guid_bytes.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

}  // namespace

void ReceivedRequest::complete(const eprosima::fastdds::dds::SampleInfo& info) {
    identity_.writer = bytes_of(info.sample_identity.writer_guid());
    identity_.client_id = printable(sample.client_id());
    identity_.request_id = printable(sample.request_id());
    identity_.payload_hash = sample.payload_hash;
}

std::optional<OpenedCall> open_service_call(std::span<std::uint8_t> payload,
                                            const eprosima::fastdds::dds::SampleInfo& info) {
    OpenedCall opened{{}, 0, payload};
    if (info.related_sample_identity.writer_guid() != GUID_t::unknown()) {
        auto& related = opened.call.related.emplace();
        related.writer_guid(info.related_sample_identity.writer_guid());
        related.sequence_number(info.sample_identity.sequence_number());
        opened.number =
            static_cast<std::int64_t>(info.sample_identity.sequence_number().to64long());
        return opened;
    }
    const auto header = take_service_header(opened.members);
    if (!header) return std::nullopt;
    opened.call.header = *header;
    opened.number = header->sequence;
    return opened;
}

std::unique_ptr<ReceivedRequest> read_service_call(Bytes payload,
                                                   const eprosima::fastdds::dds::SampleInfo& info,
                                                   const PayloadGuard& guard, bool keep_payload) {
    const auto opened = open_service_call(payload, info);
    if (!opened) return nullptr;
    auto request = std::make_unique<ReceivedRequest>();
    request->call = opened->call;
    // The request's message has one member, so its bytes are those of a GraspRequest_.
    if (keep_payload) {
        request->sample.payload = std::make_shared<ReceivedPayload>();
        request->sample.payload->by_service = true;
    }
    if (!request->sample.read(opened->members, guard)) return nullptr;
    if (request->sample.request_id().empty()) {
        request->sample.request_id("call-" + std::to_string(opened->number));
    }
    request->complete(info);
    return request;
}

}  // namespace graspd::dds
