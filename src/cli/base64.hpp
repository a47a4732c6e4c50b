#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace graspd::cli {

/// RFC 4648 base64, padded.
inline std::string base64_of(std::span<const std::uint8_t> bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t group = (std::uint32_t{bytes[i]} << 16) |
                                    (left > 1 ? std::uint32_t{bytes[i + 1]} << 8 : 0U) |
                                    (left > 2 ? std::uint32_t{bytes[i + 2]} : 0U);
        text += kDigits[group >> 18];
        text += kDigits[(group >> 12) & 63U];
        text += left > 1 ? kDigits[(group >> 6) & 63U] : '=';
        text += left > 2 ? kDigits[group & 63U] : '=';
    }
    return text;
}

/// The values' own bytes, as a typed array of a page reads them.
template <class Number>
std::string base64_of(const std::vector<Number>& values) {
    static_assert(std::endian::native == std::endian::little);
    return base64_of(std::span(reinterpret_cast<const std::uint8_t*>(values.data()),
                               values.size() * sizeof(Number)));
}

}  // namespace graspd::cli
