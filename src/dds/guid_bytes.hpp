#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <fastdds/rtps/common/Guid.h>

namespace graspd::dds {

/// A GUID as sixteen bytes: prefix, then entity id.
inline std::array<std::uint8_t, 16> bytes_of(const eprosima::fastrtps::rtps::GUID_t& guid) {
    std::array<std::uint8_t, 16> out{};
    const auto rest = std::ranges::copy(guid.guidPrefix.value, out.begin()).out;
    std::ranges::copy(guid.entityId.value, rest);
    return out;
}

}  // namespace graspd::dds
