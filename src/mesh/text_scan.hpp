#pragma once

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "graspd/base/result.hpp"

namespace graspd::mesh_detail {

/// An unreadable-file error put together from parts.
template <class... Parts>
PlanError unreadable(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return PlanError{PlanErrorCode::kUnreadableFile, text.str()};
}

inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// At most 40 printable characters of a token, for messages about files that may hold anything.
inline std::string shown(std::string_view token) {
    std::string text = "'";
    for (const char c : token.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + (token.size() > 40 ? "...'" : "'");
}

/// Walks over text by tokens and by lines; numbers are read without regard to the locale.
class TextScan {
public:
    explicit TextScan(std::string_view text) : text_(text) {}

    bool at_end() const { return place_ >= text_.size(); }
    std::size_t line() const { return line_; }  ///< of the next character, from 1
    std::string_view rest() const { return text_.substr(place_); }

    /// The next token of this line; empty at its end.
    std::string_view token_of_line() {
        while (!at_end() && is_blank(text_[place_])) ++place_;
        const std::size_t begin = place_;
        while (!at_end() && text_[place_] != '\n' && !is_blank(text_[place_])) ++place_;
        return text_.substr(begin, place_ - begin);
    }
    /// The next token, on whatever line; empty at the end of the text.
    std::string_view token() {
        std::string_view found = token_of_line();
        while (found.empty() && next_line()) found = token_of_line();
        return found;
    }
    /// Moves behind the end of the line; false when the text ends.
    bool next_line() {
        place_ = text_.find('\n', place_);
        if (place_ == std::string_view::npos) {
            place_ = text_.size();
            return false;
        }
        ++place_;
        ++line_;
        return true;
    }
    /// Moves to the next line whose first token does not start a comment; false at the end.
    bool seek_content(char comment = '#') {
        while (!at_end()) {
            while (!at_end() && is_blank(text_[place_])) ++place_;
            if (!at_end() && text_[place_] != '\n' && text_[place_] != comment) return true;
            if (!next_line()) return false;
        }
        return false;
    }

private:
    std::string_view text_;
    std::size_t place_ = 0;
    std::size_t line_ = 1;
};

/// The whole token as a number; "nan" and "inf" in any case are numbers.
inline std::optional<double> to_number(std::string_view token) {
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    double value = 0.0;
    const auto [end, status] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (status == std::errc::result_out_of_range) {  // too small or too large for a double
        value = std::strtod(std::string(token).c_str(), nullptr);
    } else if (status != std::errc()) {
        return std::nullopt;
    }
    if (end != token.data() + token.size()) return std::nullopt;
    return value;
}

/// The whole token as an integer.
inline std::optional<std::int64_t> to_integer(std::string_view token) {
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, status] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (status != std::errc() || end != token.data() + token.size()) return std::nullopt;
    return value;
}

}  // namespace graspd::mesh_detail
