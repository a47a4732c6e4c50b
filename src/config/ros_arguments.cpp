#include "graspd/config/ros_arguments.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "split_text.hpp"
#include "yaml_scalar.hpp"

namespace graspd {
namespace {

using config_detail::bad_value;
using config_detail::split_text;
using What = RemapRule::What;

/// An option of a section: its long spelling, and the word after it if it takes one.
struct Option {
    std::string name;
    std::string value;
};

struct Spelling {
    std::string_view typed;
    std::string_view name;
    bool takes_value;
};

constexpr std::array<Spelling, 17> kSpellings = {{
    {"-r", "--remap", true},
    {"--remap", "--remap", true},
    {"-p", "--param", true},
    {"--param", "--param", true},
    {"--params-file", "--params-file", true},
    {"--log-level", "--log-level", true},
    {"-e", "--enclave", true},
    {"--enclave", "--enclave", true},
    {"--log-config-file", "--log-config-file", true},
    {"--log-file-name", "--log-file-name", true},
    {"--enable-rosout-logs", "--enable-rosout-logs", false},
    {"--disable-rosout-logs", "--disable-rosout-logs", false},
    {"--enable-stdout-logs", "--enable-stdout-logs", false},
    {"--disable-stdout-logs", "--disable-stdout-logs", false},
    {"--enable-external-lib-logs", "--enable-external-lib-logs", false},
    {"--disable-external-lib-logs", "--disable-external-lib-logs", false},
    {"--ros-args", "--ros-args", false},
}};

PlanError invalid_argument(std::string detail) {
    return {PlanErrorCode::kInvalidInput, std::move(detail)};
}

/// Moves the sections' options from `arguments` to the result and the other words to `own`.
Result<std::vector<Option>> split_sections(const std::vector<std::string>& arguments,
                                           std::vector<std::string>& own) {
    std::vector<Option> options;
    bool inside = false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (!inside) {
            inside = word == "--ros-args";
            if (!inside) own.push_back(word);
            continue;
        }
        if (word == "--") {
            inside = false;
            continue;
        }
        const auto found = std::ranges::find(kSpellings, word, &Spelling::typed);
        if (found == kSpellings.end()) {
            return invalid_argument("--ros-args: unknown argument " + word +
                                    " (-- ends the ROS arguments)");
        }
        options.push_back({std::string(found->name), ""});
        if (!found->takes_value) continue;
        if (++i == arguments.size()) return invalid_argument("--ros-args: no value after " + word);
        options.back().value = arguments[i];
    }
    return options;
}

std::string full_node_name(const RosArguments& ros) {
    return (ros.node_namespace == "/" ? "/" : ros.node_namespace + "/") + ros.node_name;
}

std::optional<PlanError> read_rules(const std::vector<Option>& options, RosArguments& ros) {
    for (const Option& option : options) {
        if (option.name != "--remap") continue;
        auto rule = parse_remap_rule(option.value);
        if (!rule.ok()) return rule.error();
        ros.rules.push_back(std::move(rule).value());
    }
    const auto first_of = [&](What what) {  // asks for the node's name of that moment
        return std::ranges::find_if(ros.rules, [&](const RemapRule& rule) {
            return rule.what == what && (rule.node.empty() || rule.node == ros.node_name);
        });
    };
    const auto name = first_of(What::kNodeName);
    if (name != ros.rules.end()) ros.node_name = name->to;
    const auto space = first_of(What::kNamespace);
    if (space != ros.rules.end()) ros.node_namespace = space->to;
    return std::nullopt;
}

/// The YAML text of a scalar, quoted when it was a text in quotes; nothing for anything else.
std::optional<std::string> scalar_text(const YAML::Node& node) {
    if (!node.IsScalar()) return std::nullopt;
    if (node.Tag() != "!" && node.Tag() != "tag:yaml.org,2002:str") return node.Scalar();
    YAML::Emitter quoted;
    quoted << YAML::DoubleQuoted << node.Scalar();
    return quoted.c_str();
}

/// Parts joined by dots, in them tokens and slashes; no token starts with a digit or "__".
bool is_parameter_name(const std::string& name) {
    for (const std::string& part : split_text(name, '.')) {
        if (part.empty()) return false;
        for (const std::string& token : split_text(part, '/')) {
            if (token.empty()) continue;
            if (token.starts_with("__") || check_node_name("token", token)) return false;
        }
    }
    return true;
}

std::optional<PlanError> add_parameter(const std::string& text, RosArguments& ros) {
    const std::size_t separator = text.find(":=");
    const std::size_t colon = text.find(':');
    const bool has_node = colon < separator;
    std::string name = text.substr(0, separator);
    const std::string node = has_node ? name.substr(0, colon) : ros.node_name;
    if (has_node) name.erase(0, colon + 1);
    if (separator == std::string::npos || !is_parameter_name(name) ||
        check_node_name("node", node)) {
        return invalid_argument("--param " + text + " must read [NODE:]NAME:=VALUE");
    }
    if (node != ros.node_name) return std::nullopt;
    try {
        if (auto value = scalar_text(YAML::Load(text.substr(separator + 2)))) {
            ros.parameters.emplace_back(name, *std::move(value));
            return std::nullopt;
        }
    } catch (const YAML::Exception&) {  // told below
    }
    return invalid_argument("--param " + text + " must have one YAML scalar after :=");
}

/// The daemon's word for one of rcutils' severities; nothing when it is none.
std::optional<std::string> daemon_level(std::string level) {
    for (char& c : level) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    if (level == "debug" || level == "info" || level == "error") return level;
    if (level == "warn") return "warning";
    if (level == "fatal") return "error";
    return std::nullopt;
}

/// rcl's name of the node's logger: "cell1.graspd" for /cell1/graspd.
std::string logger_name(const RosArguments& ros) {
    std::string name = full_node_name(ros).substr(1);
    std::ranges::replace(name, '/', '.');
    return name;
}

std::optional<PlanError> read_log_level(const std::vector<Option>& options, RosArguments& ros) {
    const std::string ours = logger_name(ros) + ".";
    std::size_t nearest = 0;  // length of the logger's name whose level holds so far
    for (const Option& option : options) {
        if (option.name != "--log-level") continue;
        const std::size_t separator = option.value.find(":=");
        const bool for_all = separator == std::string::npos;
        const std::string logger = for_all ? "" : option.value.substr(0, separator);
        auto level = daemon_level(for_all ? option.value : option.value.substr(separator + 2));
        if (!level || (!for_all && logger.empty())) {
            return invalid_argument(
                "--log-level " + option.value +
                " must read [LOGGER:=]LEVEL, LEVEL one of debug, info, warn, error, "
                "fatal");
        }
        if (!for_all && !ours.starts_with(logger + ".")) continue;
        if (logger.size() < nearest) continue;
        nearest = logger.size();
        ros.log_level = std::move(level);
    }
    return std::nullopt;
}

/// What is read from a parameters file, and for whom.
struct ParamsFile {
    const std::filesystem::path& file;
    std::string node;  // full name
    RosParameters parameters;
    std::size_t groups = 0;  // that were walked
};

// An alias (*name) may stand for a group that holds it, or groups may double at every level: both
// are small files without an end.
constexpr int kMostNesting = 32;
constexpr std::size_t kMostGroups = 100000;

std::optional<PlanError> check_size(const YAML::Node& group, const std::string& key, int depth,
                                    ParamsFile& to) {
    if (depth <= kMostNesting && ++to.groups <= kMostGroups) return std::nullopt;
    return bad_value(to.file, group, key,
                     depth > kMostNesting
                         ? "is nested deeper than " + std::to_string(kMostNesting) + " groups"
                         : "is one group more than " + std::to_string(kMostGroups));
}

std::string joined(std::string left, char separator, const std::string& right) {
    if (!left.empty() && left.back() != separator) left += separator;
    return left += right;
}

std::optional<PlanError> add_group(const YAML::Node& group, const std::string& prefix, int depth,
                                   ParamsFile& to) {
    const std::string place = prefix.empty() ? "ros__parameters" : prefix;
    if (auto error = check_size(group, place, depth, to)) return error;
    if (!group.IsMap()) return bad_value(to.file, group, place, "must be a group of parameters");
    std::set<std::string> seen;
    for (const auto& entry : group) {
        if (!entry.first.IsScalar() || entry.first.Scalar().empty()) {
            return bad_value(to.file, entry.first, place, "has a key that is no word");
        }
        const std::string& key = entry.first.Scalar();
        const std::string name = joined(prefix, '.', key);
        if (!seen.insert(key).second) {
            return config_detail::repeated_key(to.file, entry.first, name);
        }
        if (auto value = scalar_text(entry.second)) {
            to.parameters.emplace_back(name, *std::move(value));
        } else if (!entry.second.IsMap()) {
            return bad_value(to.file, entry.second, name, "must be one value (no list)");
        } else if (auto error = add_group(entry.second, name, depth + 1, to)) {
            return error;
        }
    }
    return std::nullopt;
}

std::optional<PlanError> add_nodes(const YAML::Node& group, const std::string& key, int depth,
                                   ParamsFile& to) {
    if (auto error = check_size(group, key, depth, to)) return error;
    if (!group.IsMap()) {
        return bad_value(to.file, group, key, "must be a group of keys with ros__parameters in it");
    }
    for (const auto& entry : group) {
        if (!entry.first.IsScalar()) {
            return bad_value(to.file, entry.first, key, "has a key that is no word");
        }
        const std::string& word = entry.first.Scalar();
        if (word != "ros__parameters") {
            const std::string inner = joined(key, '/', word);
            if (auto error = add_nodes(entry.second, inner, depth + 1, to)) return error;
            continue;
        }
        if (key.empty()) return bad_value(to.file, entry.second, word, "must stand below a node");
        const auto ours = node_key_matches(key, to.node);
        if (!ours.ok()) return invalid_argument(to.file.string() + ": " + ours.error().detail);
        if (!ours.value()) continue;
        if (auto error = add_group(entry.second, "", depth + 1, to)) return error;
    }
    return std::nullopt;
}

}  // namespace

Result<RosArguments> take_ros_arguments(std::vector<std::string>& arguments) {
    std::vector<std::string> own;
    const auto options = split_sections(arguments, own);
    if (!options.ok()) return options.error();
    RosArguments ros;
    if (auto error = read_rules(options.value(), ros)) return *std::move(error);
    if (auto error = read_log_level(options.value(), ros)) return *std::move(error);
    for (const Option& option : options.value()) {
        std::optional<PlanError> error;
        if (option.name == "--param") error = add_parameter(option.value, ros);
        if (option.name == "--params-file") ros.params_files.push_back(option.value);
        if (option.name == "--enclave") {
            error = check_enclave("--enclave", option.value);
            ros.enclave = option.value;
        }
        if (error) return *std::move(error);
    }
    arguments = std::move(own);
    return ros;
}

Result<std::string> resolve_name(const RosArguments& ros, const std::string& name,
                                 RosNameKind kind) {
    const What limited = kind == RosNameKind::kTopic ? What::kTopic : What::kService;
    auto full = expand_name(name, ros.node_namespace, ros.node_name);
    if (!full.ok()) return full;
    for (const RemapRule& rule : ros.rules) {
        if (rule.what != limited && rule.what != What::kTopicOrService) continue;
        if (!rule.node.empty() && rule.node != ros.node_name) continue;
        const auto from = expand_name(rule.from, ros.node_namespace, ros.node_name);
        if (!from.ok() || from.value() != full.value()) continue;
        return expand_name(rule.to, ros.node_namespace, ros.node_name);
    }
    return full;
}

Result<RosParameters> read_params_file(const std::filesystem::path& file, const RosArguments& ros) {
    const auto root = config_detail::load_yaml(file);
    if (!root.ok()) return root.error();
    ParamsFile to{file, full_node_name(ros), {}, 0};
    if (root.value().IsNull()) return to.parameters;  // an empty file says nothing
    if (auto error = add_nodes(root.value(), "", 0, to)) return *std::move(error);
    return std::move(to.parameters);
}

}  // namespace graspd
