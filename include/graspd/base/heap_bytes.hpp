#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace graspd {

/// Memory that a vector's elements take where they lie [bytes], not what those own in turn.
template <class T>
std::uint64_t heap_bytes(const std::vector<T>& items) {
    return std::uint64_t{items.capacity()} * sizeof(T);
}

/// Memory that a text takes outside itself [bytes]; none for a short one.
inline std::uint64_t heap_bytes(const std::string& text) {
    const auto* begin = reinterpret_cast<const char*>(&text);
    const bool inside = text.data() >= begin && text.data() < begin + sizeof(std::string);
    return inside ? 0 : std::uint64_t{text.capacity()} + 1;
}

}  // namespace graspd
