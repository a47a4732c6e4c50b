#include "received_sample.hpp"

#include <fastcdr/Cdr.h>

#include <bit>
#include <cstring>

#include "cdr_layout.hpp"
#include "convert_basics.hpp"
#include "graspd/base/content_hash.hpp"

namespace graspd::dds {
namespace {

using eprosima::fastcdr::Cdr;

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
    if (payload) payload->bytes.assign(bytes.begin(), bytes.end());
}

}  // namespace graspd::dds
