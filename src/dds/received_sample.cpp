#include "received_sample.hpp"

#include <fastcdr/Cdr.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "cdr_layout.hpp"
#include "convert_basics.hpp"
#include "graspd/base/content_hash.hpp"
#include "guarded_type.hpp"
#include "request_limits.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastcdr::Cdr;

// Enough for every name of a request, with a header on a service's call.
constexpr std::size_t kNames_bytes = 4096;
constexpr std::size_t kLeastPoint_bytes = 12;  // three floats

/// A sequence whose elements are `Number`s alone lies in the payload as in memory.
/// @param body  the payload's first byte behind the encapsulation, from which CDR aligns
template <class Number, class Element>
void take_block(Cdr& cdr, const std::uint8_t* body, std::vector<Element>& elements) {
    static_assert(sizeof(Element) == 3 * sizeof(Number));
    std::uint32_t count = 0;
    cdr >> count;
    elements.resize(count);
    if (count == 0) return;  // no padding before elements that are not there
    const auto* at = reinterpret_cast<const std::uint8_t*>(cdr.getCurrentPosition());
    const std::size_t past = static_cast<std::size_t>(at - body) % sizeof(Number);
    const std::size_t padding = past == 0 ? 0 : sizeof(Number) - past;
    const std::size_t bytes = elements.size() * sizeof(Element);
    if (!cdr.jump(padding + bytes)) throw std::bad_alloc();  // never: the guard walked this
    std::memcpy(static_cast<void*>(elements.data()), at + padding, bytes);
}

/// The members up to object_key, which come first. Throws what fastcdr throws.
void read_names(std::span<std::uint8_t> payload, wire::GraspRequest_& sample) {
    const auto first = payload.first(std::min(payload.size(), kNames_bytes));
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(first.data()), first.size());
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    sample.header().deserialize(cdr);
    cdr >> sample.client_id() >> sample.request_id() >> sample.object_key();
}

}  // namespace

// The members in the order of idl/graspd.idl.
void ReceivedSample::read(std::span<std::uint8_t> bytes) {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    const auto* body = reinterpret_cast<const std::uint8_t*>(cdr.getCurrentPosition());
    cdr >> header() >> client_id() >> request_id() >> object_key();
    if (cdr.endianness() == Cdr::DEFAULT_ENDIAN) {
        take_block<std::uint32_t>(cdr, body, mesh_O.faces);
        take_block<double>(cdr, body, mesh_O.vertices);
    } else {
        shape_msgs::msg::dds_::Mesh_ mesh;
        cdr >> mesh;
        mesh_O = read_mesh(mesh);
    }
    cdr >> cloud() >> sensor_origin() >> object_pose() >> gripper() >> grippers() >>
        support_plane() >> obstacles() >> obstacle_cloud() >> approach_cones() >>
        keep_out_boxes() >> options();
    payload_hash = content_hash(std::as_bytes(bytes));
}

bool ReceivedSample::read(std::span<std::uint8_t> bytes, std::uint64_t sent_bytes,
                          const PayloadGuard& guard) {
    static const CdrStruct* const layout =
        wire_layouts().find("graspd_msgs::msg::dds_::GraspRequest_");
    received = std::chrono::steady_clock::now();
    RequestCounts counts;
    const auto count = [&](const CdrMember& member, const CdrMember& sequence, std::uint64_t n) {
        counts.see(member.name, sequence.name, n, sequence.most);
    };
    refused = too_many_bytes(sent_bytes, guard.max_payload_bytes);
    if (!refused && !is_well_formed(bytes, *layout, count)) return false;
    if (refused) payload = nullptr;  // no file for what no memory is spent on
    if (payload) payload->bytes.assign(bytes.begin(), bytes.end());
    if (!refused) refused = counts.over(guard.limits);
    if (refused) {
        payload_hash =
            content_hash(std::as_bytes(bytes.first(std::min(bytes.size(), kNames_bytes))));
        try {
            read_names(bytes, *this);
            return true;
        } catch (...) {  // fastcdr's exceptions, bad_alloc
            return false;
        }
    }
    try {
        read(bytes);
    } catch (...) {  // fastcdr's exceptions, bad_alloc
        return false;
    }
    size = counts.size();
    size.points = std::min(std::uint64_t{cloud().width()} * cloud().height(),
                           cloud().data().size() / kLeastPoint_bytes);
    refused = too_many_points(size.points, guard.limits);
    return true;
}

}  // namespace graspd::dds
