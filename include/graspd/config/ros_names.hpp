#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "graspd/base/result.hpp"

namespace graspd {

/// What a ROS 2 name is the name of.
enum class RosNameKind : std::uint8_t { kTopic, kService };

/// Which DDS topic stands for a ROS 2 name: a topic's own, or one of the two of a service.
enum class DdsTopicKind : std::uint8_t { kTopic, kServiceRequest, kServiceReply };

/// One of ROS 2's remapping rules, `[NODE:]FROM:=TO`.
struct RemapRule {
    enum class What : std::uint8_t { kNodeName, kNamespace, kTopic, kService, kTopicOrService };
    What what = What::kTopicOrService;
    std::string node;  ///< the rule is for the node of that name alone; empty: for every node
    std::string from;  ///< a relative, private (~/x) or absolute name; empty for node and namespace
    std::string to;    ///< the node's new name, its new namespace, or a name of the three forms
};

/// Reads `[NODE:]FROM:=TO` as rcl does: FROM is __node or __name, __ns, or a topic's or service's
/// name, which rostopic:// or rosservice:// before it limits to one of the two. No wildcards and
/// no back references (rcl has none either).
/// @return kInvalidInput naming the rule and what is wrong with it
Result<RemapRule> parse_remap_rule(const std::string& text);

/// Whether ROS 2 allows a node's name: 1 to 255 letters, digits and underscores, no digit first.
/// @return nothing when it does; else kInvalidInput naming `what`, the value and the reason
std::optional<PlanError> check_node_name(const std::string& what, const std::string& name);

/// Whether ROS 2 allows a namespace (at most 245 characters) or an enclave (at most 255): "/", or
/// /token/token with tokens as of a node's name, without a slash at the end.
std::optional<PlanError> check_namespace(const std::string& what, const std::string& name);
std::optional<PlanError> check_enclave(const std::string& what, const std::string& name);

/// The absolute form of a relative ("a/b"), private ("~", "~/a") or absolute ("/a") name for a node
/// whose name and namespace are valid, checked as ROS 2 does: no "//", at most 247 characters.
/// Deviation: no substitutions such as {node}; a brace is a character that is not allowed.
/// @return kInvalidInput naming the expanded name and the reason
Result<std::string> expand_name(const std::string& name, const std::string& node_namespace,
                                const std::string& node_name);

/// Whether the key of a parameters file speaks of the node with that full name. Keys are names with
/// or without a leading slash, in which * stands for one token and ** for any number of them.
/// @return kInvalidInput for a key that is no such name, as "/a//b" or "/a*"
Result<bool> node_key_matches(const std::string& key, const std::string& full_node_name);

/// The DDS topic that ROS 2 uses for a full name: "rt" + name, "rq" + name + "Request",
/// "rr" + name + "Reply".
std::string dds_topic_name(const std::string& ros_name, DdsTopicKind kind);

}  // namespace graspd
