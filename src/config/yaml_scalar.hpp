#pragma once

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/config/load_config.hpp"

namespace graspd::config_detail {

// What load_config and load_gripper share of reading YAML strictly: yaml-cpp's own conversions turn
// "-1" into a large unsigned number and "0x10" or "1 m" into something.

/// Parses a file. @return its root node; kUnreadableFile with yaml-cpp's line and reason.
Result<YAML::Node> load_yaml(const std::filesystem::path& file);

/// Writes the values of a parsed map into the settings; every key must be known.
std::optional<PlanError> assign_yaml(const std::filesystem::path& file, const YAML::Node& root,
                                     const std::vector<SettingRef>& settings,
                                     const std::vector<std::string>& foreign_groups);

/// "FILE:LINE: KEY = VALUE MUST"
PlanError bad_value(const std::filesystem::path& file, const YAML::Node& node,
                    const std::string& key, const std::string& must);
PlanError repeated_key(const std::filesystem::path& file, const YAML::Node& node,
                       const std::string& key);
PlanError unknown_key(const std::filesystem::path& file, const YAML::Node& node,
                      const std::string& key, const std::string& known);

/// Reads a plain (unquoted) number completely. @return whether it was one of that type.
template <class Number>
requires std::is_arithmetic_v<Number>
bool parse_scalar(const YAML::Node& node, Number& value) {
    if (!node.IsScalar() || node.Tag() == "!") return false;
    const std::string& text = node.Scalar();
    const auto end = text.data() + text.size();
    Number parsed{};
    const auto got = std::from_chars(text.data(), end, parsed);
    if (got.ec != std::errc{} || got.ptr != end) return false;
    value = parsed;
    return true;
}
bool parse_scalar(const YAML::Node& node, bool& value);
bool parse_scalar(const YAML::Node& node, std::string& value);

inline const char* scalar_name(bool) {
    return "true or false";
}
inline const char* scalar_name(double) {
    return "a number";
}
inline const char* scalar_name(const std::string&) {
    return "a text";
}
inline const char* scalar_name(std::int32_t) {
    return "an integer";
}
inline const char* scalar_name(std::uint32_t) {
    return "an integer";
}
inline const char* scalar_name(std::uint64_t) {
    return "an integer";
}

}  // namespace graspd::config_detail
