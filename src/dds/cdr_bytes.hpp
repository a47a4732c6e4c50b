#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include <fastcdr/Cdr.h>

#include "raw_type.hpp"

namespace graspd::dds {

/// What rmw_cyclonedds writes between the encapsulation header and the members of a service's
/// request, and expects before those of the reply.
struct ServiceHeader {
    std::uint64_t client = 0;
    std::int64_t sequence = 0;

    friend bool operator==(const ServiceHeader&, const ServiceHeader&) = default;
};

inline constexpr std::size_t kEncapsulation_bytes = 4;
inline constexpr std::size_t kServiceHeader_bytes = 16;

/// The payload of a sample: encapsulation CDR_LE, the header where there is one, the members.
template <class Struct>
Bytes cdr_bytes(const Struct& sample, const std::optional<ServiceHeader>& header = {}) {
    using eprosima::fastcdr::Cdr;
    Bytes bytes(kEncapsulation_bytes + kServiceHeader_bytes + Struct::getCdrSerializedSize(sample));
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    if (header) cdr << header->client << header->sequence;
    sample.serialize(cdr);
    bytes.resize(cdr.getSerializedDataLength());
    return bytes;
}

/// Takes the header out of a payload that has one: what is left is a payload as without it, in the
/// last bytes of the same memory (16 is a multiple of every alignment). @return nothing for a
/// payload that is too short
inline std::optional<ServiceHeader> take_service_header(std::span<std::uint8_t>& payload) {
    if (payload.size() < kEncapsulation_bytes + kServiceHeader_bytes) return std::nullopt;
    const bool little = payload[1] == 1;
    const auto number_at = [&](std::size_t at) {
        std::uint64_t number = 0;
        for (std::size_t i = 0; i < 8; ++i)
            number = number << 8 | payload[at + (little ? 7 - i : i)];
        return number;
    };
    const ServiceHeader header{number_at(4), static_cast<std::int64_t>(number_at(12))};
    std::memmove(payload.data() + kServiceHeader_bytes, payload.data(), kEncapsulation_bytes);
    payload = payload.subspan(kServiceHeader_bytes);
    return header;
}

/// Reads a payload into a generated struct, after walking its bytes (cdr_layout.hpp).
/// @return false: malformed; the sample may hold a part then
template <class Struct>
bool read_cdr(std::span<std::uint8_t> payload, const CdrStruct& layout, Struct& sample) {
    if (!is_well_formed(payload, layout)) return false;
    try {
        eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data()),
                                             payload.size());
        eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                                   eprosima::fastcdr::Cdr::DDS_CDR);
        cdr.read_encapsulation();
        sample.deserialize(cdr);
        return true;
    } catch (...) {  // fastcdr's exceptions, bad_alloc
        return false;
    }
}

}  // namespace graspd::dds
