#include "graspd/config/ros_names.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "refused.hpp"
#include "split_text.hpp"

namespace graspd {
namespace {

using config_detail::split_text;

// The limits of rmw's validate_node_name.h, validate_full_topic_name.h and validate_namespace.h,
// and of rcl's validate_enclave_name.h.
constexpr std::size_t kLongestNodeName = 255;
constexpr std::size_t kLongestName = 247;
constexpr std::size_t kLongestNamespace = 245;
constexpr std::size_t kLongestEnclave = 255;
constexpr std::string_view kTopicScheme = "rostopic://";
constexpr std::string_view kServiceScheme = "rosservice://";

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Of the 26 letters, whatever the locale.
bool is_word_character(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// What is wrong with one token of a name; empty when nothing is.
std::string token_fault(const std::string& token) {
    if (token.empty()) return "must not be empty";
    if (!std::ranges::all_of(token, is_word_character)) {
        return "must hold nothing but letters, digits, '_' and '/'";
    }
    return is_digit(token.front()) ? "must not have a token that starts with a digit" : "";
}

/// What is wrong with an absolute name of at most `longest` characters.
std::string name_fault(const std::string& name, std::size_t longest) {
    if (name.empty()) return "must not be empty";
    if (name.front() != '/') return "must start with '/'";
    if (name.back() == '/') return "must not end with '/'";
    if (name.find("//") != std::string::npos) return "must not hold '//'";
    for (const std::string& token : split_text(name.substr(1), '/')) {
        if (auto fault = token_fault(token); !fault.empty()) return fault;
    }
    if (name.size() > longest) {
        return "must have at most " + std::to_string(longest) + " characters";
    }
    return "";
}

/// A token as rcl's lexer reads it in rules: names at large may hold "__", those of rules may not.
bool is_rule_token(const std::string& token) {
    return token_fault(token).empty() && token.find("__") == std::string::npos;
}

bool is_rule_name(const std::string& name) {
    const std::size_t start = name.starts_with("~/") ? 2 : (name.starts_with("/") ? 1 : 0);
    return std::ranges::all_of(split_text(name.substr(start), '/'), is_rule_token);
}

/// Takes NODE: and the scheme off the left side of a rule. @return whether NODE was a token
bool take_prefixes(std::string& left, RemapRule& rule) {
    const bool has_scheme = left.starts_with(kTopicScheme) || left.starts_with(kServiceScheme);
    const std::size_t colon = has_scheme ? std::string::npos : left.find(':');
    if (colon != std::string::npos) {
        rule.node = left.substr(0, colon);
        left.erase(0, colon + 1);
        if (!is_rule_token(rule.node)) return false;
    }
    if (left.starts_with(kTopicScheme)) {
        rule.what = RemapRule::What::kTopic;
        left.erase(0, kTopicScheme.size());
    } else if (left.starts_with(kServiceScheme)) {
        rule.what = RemapRule::What::kService;
        left.erase(0, kServiceScheme.size());
    }
    return true;
}

bool tokens_match(std::span<const std::string> pattern, std::span<const std::string> name) {
    if (pattern.empty()) return name.empty();
    if (pattern.front() == "**") {
        return tokens_match(pattern.subspan(1), name) ||
               (!name.empty() && tokens_match(pattern, name.subspan(1)));
    }
    if (name.empty()) return false;
    if (pattern.front() != "*" && pattern.front() != name.front()) return false;
    return tokens_match(pattern.subspan(1), name.subspan(1));
}

}  // namespace

std::optional<PlanError> check_node_name(const std::string& what, const std::string& name) {
    if (const auto fault = token_fault(name); !fault.empty()) return refused(what, name, fault);
    if (name.size() <= kLongestNodeName) return std::nullopt;
    return refused(what, name, "must have at most 255 characters");
}

std::optional<PlanError> check_namespace(const std::string& what, const std::string& name) {
    const auto fault = name == "/" ? "" : name_fault(name, kLongestNamespace);
    if (fault.empty()) return std::nullopt;
    return refused(what, name, fault);
}

std::optional<PlanError> check_enclave(const std::string& what, const std::string& name) {
    const auto fault = name == "/" ? "" : name_fault(name, kLongestEnclave);
    if (fault.empty()) return std::nullopt;
    return refused(what, name, fault);
}

Result<RemapRule> parse_remap_rule(const std::string& text) {
    using What = RemapRule::What;
    const std::string what = "remapping rule";
    const std::size_t separator = text.find(":=");
    if (separator == std::string::npos) return refused(what, text, "must read [NODE:]FROM:=TO");
    RemapRule rule;
    rule.to = text.substr(separator + 2);
    std::string left = text.substr(0, separator);
    if (!take_prefixes(left, rule)) return refused(what, text, "must name a node before ':'");
    const bool has_scheme = rule.what != What::kTopicOrService;
    if (!has_scheme && (left == "__node" || left == "__name")) {
        rule.what = What::kNodeName;
        if (!is_rule_token(rule.to)) return refused(what, text, "must give a node's name");
        if (auto error = check_node_name(what, rule.to)) return *std::move(error);
        return rule;
    }
    if (!has_scheme && left == "__ns") {
        rule.what = What::kNamespace;
        if (auto error = check_namespace(what + " " + text + ": namespace", rule.to)) {
            return *std::move(error);
        }
        if (rule.to == "/" || is_rule_name(rule.to)) return rule;
        return refused(what, text, "must not hold '__' in the namespace");
    }
    rule.from = left;
    if (is_rule_name(rule.from) && is_rule_name(rule.to)) return rule;
    return refused(what, text,
                   "must have names left and right of := (x, ~/x or /x; tokens of letters, digits "
                   "and single '_', no digit first)");
}

Result<std::string> expand_name(const std::string& name, const std::string& node_namespace,
                                const std::string& node_name) {
    const std::string what = "ROS name";
    if (name.empty()) return refused(what, name, "must not be empty");
    const std::string inside = node_namespace == "/" ? "/" : node_namespace + "/";
    std::string full = inside + name;
    if (name.front() == '/') full = name;
    if (name.front() == '~') {
        if (name.size() > 1 && name[1] != '/') {
            return refused(what, name, "must have '/' after '~'");
        }
        full = inside + node_name + name.substr(1);
    }
    if (const auto fault = name_fault(full, kLongestName); !fault.empty()) {
        return refused(what, full, fault);
    }
    return full;
}

Result<bool> node_key_matches(const std::string& key, const std::string& full_node_name) {
    const auto pattern = split_text(key.substr(key.starts_with("/") ? 1 : 0), '/');
    for (const std::string& token : pattern) {
        if (token == "*" || token == "**") continue;
        if (const auto fault = token_fault(token); !fault.empty()) {
            return refused("node", key, fault + " (* and ** stand for whole tokens alone)");
        }
    }
    return tokens_match(pattern, split_text(full_node_name.substr(1), '/'));
}

std::string dds_topic_name(const std::string& ros_name, DdsTopicKind kind) {
    if (kind == DdsTopicKind::kServiceRequest) return "rq" + ros_name + "Request";
    if (kind == DdsTopicKind::kServiceReply) return "rr" + ros_name + "Reply";
    return "rt" + ros_name;
}

}  // namespace graspd
