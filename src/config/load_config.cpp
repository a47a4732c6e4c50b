#include "graspd/config/load_config.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "yaml_scalar.hpp"

namespace graspd {
namespace config_detail {
namespace {

/// What a file's tree is read into, and where the first problem is noted.
struct Assignment {
    const std::filesystem::path& file;
    const std::vector<SettingRef>& settings;
    const std::vector<std::string>& foreign_groups;
};

std::string join(const std::vector<std::string>& path) {
    std::string text;
    for (const std::string& name : path) text += (text.empty() ? "" : ".") + name;
    return text;
}

bool starts_with(const std::vector<std::string>& path, const std::vector<std::string>& prefix) {
    return path.size() > prefix.size() && std::equal(prefix.begin(), prefix.end(), path.begin());
}

/// The names that may stand inside a group, in order, for the message about an unknown one.
std::string known_names(const Assignment& to, const std::vector<std::string>& group) {
    std::string text;
    std::set<std::string> seen;
    for (const SettingRef& setting : to.settings) {
        if (!starts_with(setting.path, group)) continue;
        const std::string& name = setting.path[group.size()];
        if (seen.insert(name).second) text += (text.empty() ? "" : ", ") + name;
    }
    if (!group.empty()) return text;
    for (const std::string& name : to.foreign_groups) text += ", " + name;
    return text;
}

std::optional<PlanError> assign_scalar(const Assignment& to, const SettingRef& setting,
                                       const YAML::Node& node) {
    const std::string wanted = std::visit(
        [&](auto* field) -> std::string {
            return parse_scalar(node, *field) ? "" : scalar_name(*field);
        },
        setting.field);
    if (wanted.empty()) return std::nullopt;
    const std::string in = setting.range.empty() ? "" : " in " + setting.range;
    return bad_value(to.file, node, join(setting.path), "must be " + wanted + in);
}

std::optional<PlanError> assign_group(const Assignment& to, const YAML::Node& node,
                                      const std::vector<std::string>& group) {
    if (node.IsNull()) return std::nullopt;  // an empty group keeps its defaults
    if (!node.IsMap()) return bad_value(to.file, node, join(group), "must be a group of keys");
    std::set<std::string> seen;
    for (const auto& entry : node) {
        if (!entry.first.IsScalar()) {
            return bad_value(to.file, entry.first, join(group), "has a key that is no word");
        }
        std::vector<std::string> path = group;
        path.push_back(entry.first.Scalar());
        if (!seen.insert(path.back()).second) return repeated_key(to.file, entry.first, join(path));
        if (group.empty() && std::ranges::count(to.foreign_groups, path.back()) > 0) continue;
        const auto setting = std::ranges::find(to.settings, path, &SettingRef::path);
        std::optional<PlanError> error;
        if (setting != to.settings.end()) {
            error = assign_scalar(to, *setting, entry.second);
        } else if (std::ranges::any_of(to.settings,
                                       [&](const auto& s) { return starts_with(s.path, path); })) {
            error = assign_group(to, entry.second, path);
        } else {
            error = unknown_key(to.file, entry.first, join(path), known_names(to, group));
        }
        if (error) return error;
    }
    return std::nullopt;
}

template <class T>
std::string printed(T number) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return std::string(digits.data(), end);
}

std::string printed(bool value) {
    return value ? "true" : "false";
}

std::string printed(const std::string& text) {
    YAML::Emitter out;
    out << YAML::DoubleQuoted << text;
    return out.c_str();
}

}  // namespace

std::optional<PlanError> assign_yaml_file(const std::filesystem::path& file,
                                          const std::vector<SettingRef>& settings,
                                          const std::vector<std::string>& foreign_groups) {
    const auto root = load_yaml(file);
    if (!root.ok()) return root.error();
    return assign_yaml(file, root.value(), settings, foreign_groups);
}

std::optional<PlanError> assign_yaml(const std::filesystem::path& file, const YAML::Node& root,
                                     const std::vector<SettingRef>& settings,
                                     const std::vector<std::string>& foreign_groups) {
    return assign_group({file, settings, foreign_groups}, root, {});
}

std::optional<PlanError> assign_parameter(const std::string& name, const std::string& value,
                                          const std::vector<SettingRef>& settings) {
    const auto setting = std::ranges::find_if(
        settings, [&](const SettingRef& known) { return join(known.path) == name; });
    const std::string said = "parameter " + name + " = " + value;
    if (setting == settings.end()) {
        return PlanError{
            PlanErrorCode::kInvalidInput,
            said + ": graspd has no such parameter (graspd --print-config lists them)"};
    }
    const auto wanted = std::visit(
        [&](auto* field) -> std::string {
            try {
                return parse_scalar(YAML::Load(value), *field) ? "" : scalar_name(*field);
            } catch (const YAML::Exception&) {
                return scalar_name(*field);
            }
        },
        setting->field);
    if (wanted.empty()) return std::nullopt;
    const std::string in = setting->range.empty() ? "" : " in " + setting->range;
    return PlanError{PlanErrorCode::kInvalidInput, said + " must be " + wanted + in};
}

std::string print_yaml(const std::vector<SettingRef>& settings) {
    std::string text;
    std::vector<std::string> open;  // the groups whose line has been written
    for (const SettingRef& setting : settings) {
        const std::size_t groups = setting.path.size() - 1;
        std::size_t common = 0;
        while (common < groups && common < open.size() && open[common] == setting.path[common]) {
            ++common;
        }
        open.resize(common);
        for (; common < groups; ++common) {
            text += std::string(2 * common, ' ') + setting.path[common] + ":\n";
            open.push_back(setting.path[common]);
        }
        const std::string value =
            std::visit([](auto* field) { return printed(*field); }, setting.field);
        text += std::string(2 * groups, ' ') + setting.path.back() + ": " + value + "\n";
    }
    return text;
}

}  // namespace config_detail

std::string config_hash_of(std::string_view printed) {
    return to_hex(fnv1a(printed));
}

}  // namespace graspd
