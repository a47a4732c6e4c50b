#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include <fastdds/rtps/common/Guid.h>

namespace graspd::dds {

/// A GUID as sixteen bytes: prefix, then entity id.
inline std::array<std::uint8_t, 16> bytes_of(const eprosima::fastrtps::rtps::GUID_t& guid) {
    std::array<std::uint8_t, 16> out{};
    const auto rest = std::ranges::copy(guid.guidPrefix.value, out.begin()).out;
    std::ranges::copy(guid.entityId.value, rest);
    return out;
}

/// The inverse of bytes_of().
inline eprosima::fastrtps::rtps::GUID_t guid_of(const std::array<std::uint8_t, 16>& bytes) {
    eprosima::fastrtps::rtps::GUID_t guid;
    const auto rest = bytes.begin() + std::size(guid.guidPrefix.value);
    std::copy(bytes.begin(), rest, std::begin(guid.guidPrefix.value));
    std::copy(rest, bytes.end(), std::begin(guid.entityId.value));
    return guid;
}

}  // namespace graspd::dds
