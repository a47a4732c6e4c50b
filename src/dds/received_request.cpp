#include "received_request.hpp"

#include <algorithm>

#include "guid_bytes.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

void append(std::string& key, std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) key += static_cast<char>(number >> shift & 0xff);
}

}  // namespace

std::string reply_key_of(const ServiceCall& call) {
    std::string key(1, call.related ? 'r' : 'c');
    if (call.related) {
        const GuidBytes caller = bytes_of(call.related->writer_guid());
        key.append(caller.begin(), caller.end());
        append(key, call.related->sequence_number().to64long());
    } else {
        append(key, call.header.client);
        append(key, static_cast<std::uint64_t>(call.header.sequence));
    }
    return key;
}

std::optional<ServiceCall> answered_call(std::span<const std::uint8_t> payload,
                                         const eprosima::fastdds::dds::SampleInfo& info) {
    ServiceCall call;
    if (info.related_sample_identity.writer_guid() != GUID_t::unknown()) {
        call.related = info.related_sample_identity;
        return call;
    }
    Bytes head(payload.begin(),
               payload.begin() + static_cast<std::ptrdiff_t>(std::min(
                                     payload.size(), kEncapsulation_bytes + kServiceHeader_bytes)));
    std::span<std::uint8_t> rest(head);
    const auto header = take_service_header(rest);
    if (!header) return std::nullopt;
    call.header = *header;
    return call;
}

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

std::unique_ptr<ReceivedRequest> read_service_call(CallPayload payload,
                                                   const eprosima::fastdds::dds::SampleInfo& info,
                                                   const PayloadGuard& guard, bool keep_payload) {
    const auto opened = open_service_call(payload.bytes, info);
    if (!opened) return nullptr;
    auto request = std::make_unique<ReceivedRequest>();
    request->call = opened->call;
    // The request's message has one member, so its bytes are those of a GraspRequest_.
    if (keep_payload) {
        request->sample.payload = std::make_shared<ReceivedPayload>();
        request->sample.payload->by_service = true;
    }
    if (!request->sample.read(opened->members, payload.sent_bytes, guard)) return nullptr;
    if (request->sample.request_id().empty()) {
        request->sample.request_id("call-" + std::to_string(opened->number));
    }
    request->complete(info);
    return request;
}

}  // namespace graspd::dds
