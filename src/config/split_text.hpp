#pragma once

#include <string>
#include <vector>

namespace graspd::config_detail {

/// The parts between separators, empty ones too: "a//b" at '/' gives "a", "" and "b".
inline std::vector<std::string> split_text(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

}  // namespace graspd::config_detail
