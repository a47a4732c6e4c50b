#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "graspd/base/fnv1a.hpp"
#include "graspd/base/result.hpp"
#include "graspd/base/settings.hpp"

namespace graspd {

// planner.yaml is a tree of groups with the names that the structs give in describe(). A program
// that needs several structs combines them in one of its own:
//
//     struct DaemonConfig {
//         PlannerConfig planner;
//         ServerConfig server;
//         template <class Self, class Visitor> static void describe(Self& self, Visitor&& visit) {
//             PlannerConfig::describe(self.planner, visit);  // its groups at the top level
//             visit("server", self.server);
//         }
//     };

namespace config_detail {

/// One parameter: where it stands in the tree and where its value lives.
struct SettingRef {
    std::vector<std::string> path;  ///< group names, then the parameter's
    std::variant<bool*, double*, std::int32_t*, std::uint32_t*, std::uint64_t*, std::string*> field;
    std::string range;  ///< "[least, greatest]" or "[one, other]", empty for bool and free text
};

/// Flattens a settings struct into references, in the order of describe().
struct SettingCollector {
    std::vector<std::string> groups;
    std::vector<SettingRef> settings;

    template <Settings Group>
    void operator()(const char* name, Group& group) {
        groups.emplace_back(name);
        Group::describe(group, *this);
        groups.pop_back();
    }
    template <class T, class Bound>
    void operator()(const char* name, T& value, Bound least, Bound greatest) {
        std::ostringstream range;
        range << '[' << least << ", " << greatest << ']';
        add(name, &value, range.str());
    }
    void operator()(const char* name, std::string& value, Choices choices) {
        add(name, &value, '[' + listed(choices) + ']');
    }
    void operator()(const char* name, bool& value) { add(name, &value, ""); }
    void operator()(const char* name, std::string& value) { add(name, &value, ""); }

    template <class T>
    void add(const char* name, T* field, std::string range) {
        std::vector<std::string> path = groups;
        path.emplace_back(name);
        settings.push_back(SettingRef{std::move(path), field, std::move(range)});
    }
};

template <Settings T>
std::vector<SettingRef> collect(T& settings) {
    SettingCollector collector;
    T::describe(settings, collector);
    return std::move(collector.settings);
}

std::optional<PlanError> assign_yaml_file(const std::filesystem::path& file,
                                          const std::vector<SettingRef>& settings,
                                          const std::vector<std::string>& foreign_groups);
std::optional<PlanError> assign_parameter(const std::string& name, const std::string& value,
                                          const std::vector<SettingRef>& settings);
std::string print_yaml(const std::vector<SettingRef>& settings);

}  // namespace config_detail

/// Reads a YAML file over a struct of settings: keys that the file leaves out keep their default.
///
/// @param defaults        what holds for absent keys
/// @param foreign_groups  top-level groups that belong to another program and are skipped unread
/// @return the settings; kUnreadableFile when the file cannot be opened or is not YAML; else
///         kInvalidInput for an unknown or repeated key, a value of the wrong type or one out of
///         its range. The detail names the file, the line where there is one, the key's full path,
///         the value and the range.
template <Settings T>
Result<T> load_config(const std::filesystem::path& file, T defaults = {},
                      const std::vector<std::string>& foreign_groups = {}) {
    const auto settings = config_detail::collect(defaults);
    if (auto error = config_detail::assign_yaml_file(file, settings, foreign_groups)) {
        return *std::move(error);
    }
    if (auto error = validate(defaults)) {
        return PlanError{error->code, file.string() + ": " + error->detail};
    }
    return defaults;
}

/// Sets one parameter, as ROS 2's `-p server.workers:=4` does. Its range is not checked: validate()
/// does that for all of them.
///
/// @param name   groups and parameter, joined by dots
/// @param value  YAML text of one scalar
/// @return kInvalidInput for a name that is unknown or a value of the wrong type, naming both
template <Settings T>
std::optional<PlanError> set_parameter(T& settings, const std::string& name,
                                       const std::string& value) {
    return config_detail::assign_parameter(name, value, config_detail::collect(settings));
}

/// The effective settings as YAML, one key a line in the order of describe(); reading it back gives
/// the same settings bit for bit.
template <Settings T>
std::string print_config(T settings) {
    return config_detail::print_yaml(config_detail::collect(settings));
}

/// Sixteen hexadecimal digits that are equal for equal settings: FNV-1a over print_config().
std::string config_hash_of(std::string_view printed);

template <Settings T>
std::string config_hash(const T& settings) {
    return config_hash_of(print_config(settings));
}

}  // namespace graspd
