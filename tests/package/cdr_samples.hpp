#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <fastcdr/Cdr.h>

namespace cdr_samples {

using Bytes = std::vector<std::uint8_t>;

/// Reads a sample into a type of fastddsgen.
///
/// @return the bytes that are left over, at best 0; throws what fastcdr throws
template <typename Type>
std::size_t read_cdr(Bytes bytes, Type& out) {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    eprosima::fastcdr::Cdr in(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                              eprosima::fastcdr::Cdr::DDS_CDR);
    in.read_encapsulation();
    out.deserialize(in);
    return bytes.size() - in.getSerializedDataLength();
}

/// What write(cdr) writes behind an encapsulation of little-endian CDR. Padding is zero; fastcdr
/// leaves there what the buffer held before.
template <typename Write>
Bytes cdr_of(const Write& write) {
    Bytes bytes(1 << 16);
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
    eprosima::fastcdr::Cdr out(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    out.serialize_encapsulation();
    write(out);
    bytes.resize(out.getSerializedDataLength());
    return bytes;
}

/// A sample of fastddsgen's types as CDR.
template <typename Type>
Bytes write_cdr(const Type& sample) {
    return cdr_of([&sample](eprosima::fastcdr::Cdr& out) { sample.serialize(out); });
}

inline std::string golden_path(const std::string& type_name) {
    return std::string(GRASPD_SOURCE_DIR "/tests/golden/cdr/") + type_name + ".hex";
}

/// The committed bytes of one sample: hexadecimal text, 32 bytes a line; empty when there are none.
inline Bytes read_golden(const std::string& type_name) {
    std::ifstream file(golden_path(type_name));
    Bytes bytes;
    char digits[3] = {};
    while (file >> digits[0] >> digits[1]) {
        bytes.push_back(static_cast<std::uint8_t>(std::stoul(digits, nullptr, 16)));
    }
    return bytes;
}

inline void write_golden(const std::string& type_name, const Bytes& bytes) {
    std::ofstream file(golden_path(type_name));
    const char* const digits = "0123456789abcdef";
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        file << digits[bytes[i] / 16] << digits[bytes[i] % 16];
        if (i % 32 == 31 || i + 1 == bytes.size()) file << '\n';
    }
}

}  // namespace cdr_samples
