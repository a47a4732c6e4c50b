#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace graspd::mesh_detail {

static_assert(std::endian::native == std::endian::little ||
              std::endian::native == std::endian::big);

/// A number stored in the given byte order at an address of any alignment.
template <class T>
T load(const char* bytes, bool big_endian) {
    std::array<char, sizeof(T)> copy;
    std::memcpy(copy.data(), bytes, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(copy);
    return std::bit_cast<T>(copy);
}
template <class T>
T load_little(const char* bytes) {
    return load<T>(bytes, false);
}

/// Kind of a stored number: integer with or without sign, or floating point.
enum class NumberKind : std::uint8_t { kSigned, kUnsigned, kFloat };

/// How a file stores a number.
struct NumberType {
    NumberKind kind = NumberKind::kFloat;
    std::uint8_t bytes = 4;  ///< 1, 2, 4 or 8; floating point 4 or 8
};

/// Any stored number as a double (64-bit integers beyond 2^53 are rounded).
inline double load_number(const char* bytes, NumberType type, bool big_endian) {
    if (type.kind == NumberKind::kFloat) {
        return type.bytes == 4 ? double{load<float>(bytes, big_endian)}
                               : load<double>(bytes, big_endian);
    }
    const bool with_sign = type.kind == NumberKind::kSigned;
    switch (type.bytes) {
        case 1:
            return with_sign ? load<std::int8_t>(bytes, false) : load<std::uint8_t>(bytes, false);
        case 2:
            return with_sign ? load<std::int16_t>(bytes, big_endian)
                             : load<std::uint16_t>(bytes, big_endian);
        case 4:
            return with_sign ? static_cast<double>(load<std::int32_t>(bytes, big_endian))
                             : static_cast<double>(load<std::uint32_t>(bytes, big_endian));
        default:
            return with_sign ? static_cast<double>(load<std::int64_t>(bytes, big_endian))
                             : static_cast<double>(load<std::uint64_t>(bytes, big_endian));
    }
}

}  // namespace graspd::mesh_detail
