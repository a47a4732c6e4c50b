#include "graspd/dds/payloads.hpp"

#include "convert_reply.hpp"
#include "received_request.hpp"

namespace graspd {
namespace {

PlanError not_a(const char* type, std::size_t size) {
    return {PlanErrorCode::kInvalidInput,
            std::to_string(size) + " bytes are no " + type + " of this version"};
}

}  // namespace

Result<std::unique_ptr<IncomingRequest>> read_request_payload(
    std::span<const std::uint8_t> payload) {
    static const dds::CdrStruct* const layout =
        dds::wire_layouts().find("graspd_msgs::msg::dds_::GraspRequest_");
    if (layout == nullptr || !dds::is_well_formed(payload, *layout)) {
        return not_a("GraspRequest", payload.size());
    }
    auto request = std::make_unique<dds::ReceivedRequest>();
    dds::Bytes bytes(payload.begin(), payload.end());
    try {
        request->sample.read(bytes);
    } catch (...) {  // fastcdr's exceptions, bad_alloc
        return not_a("GraspRequest", payload.size());
    }
    request->complete({});
    return std::unique_ptr<IncomingRequest>(std::move(request));
}

Result<std::vector<std::uint8_t>> request_payload(const PlanRequest& request,
                                                  const std::string& client_id) {
    const auto sample = dds::write_request(request, client_id);
    if (!sample.ok()) return sample.error();
    return dds::cdr_bytes(sample.value());
}

Result<PlanReply> read_reply_payload(std::span<const std::uint8_t> payload) {
    static const dds::CdrStruct* const layout =
        dds::wire_layouts().find("graspd_msgs::msg::dds_::RankedGrasps_");
    dds::wire::RankedGrasps_ sample;
    dds::Bytes bytes(payload.begin(), payload.end());
    if (layout == nullptr || !dds::read_cdr(std::span(bytes), *layout, sample)) {
        return not_a("RankedGrasps", payload.size());
    }
    return dds::read_reply(sample);
}

std::vector<std::uint8_t> reply_payload(const PlanReply& reply) {
    dds::ReplyEnvelope envelope;
    envelope.header.frame_id(reply.frame_id);
    envelope.request_id = reply.request_id;
    return dds::cdr_bytes(dds::write_reply(reply, envelope));
}

}  // namespace graspd
