#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace graspd {

constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325u;  ///< the function's published constants
constexpr std::uint64_t kFnvPrime = 0x100000001b3u;

/// FNV-1a, 64 bit.
/// @param start  the hash of what stands before `bytes`, to go on from there
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t start = kFnvOffset) {
    std::uint64_t hash = start;
    for (const char byte : bytes) {
        hash ^= static_cast<std::uint8_t>(byte);
        hash *= kFnvPrime;
    }
    return hash;
}

/// A hash as sixteen hexadecimal digits.
inline std::string to_hex(std::uint64_t hash) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text(16, '0');
    for (auto digit = text.rbegin(); digit != text.rend(); ++digit, hash >>= 4) {
        *digit = kDigits[hash & 15u];
    }
    return text;
}

}  // namespace graspd
