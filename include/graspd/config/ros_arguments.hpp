#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graspd/base/result.hpp"
#include "graspd/config/ros_names.hpp"

namespace graspd {

/// Parameters as (name, value): groups in the name are joined by dots, as in "server.workers"; the
/// value is YAML text of one scalar, with its quotes if it had any, so that "42" and 42 differ. Of
/// several of one name the last holds.
using RosParameters = std::vector<std::pair<std::string, std::string>>;

/// What a ROS 2 user may say after a node's own arguments.
struct RosArguments {
    std::string node_name = "graspd";       ///< as remapped
    std::string node_namespace = "/";       ///< as remapped; absolute
    std::string enclave = "/";              ///< absolute; of several the last
    std::optional<std::string> log_level;   ///< debug, info, warning or error; absent: not said
    RosParameters parameters;               ///< those of -p that are for this node, in order
    std::vector<std::string> params_files;  ///< in order
    std::vector<RemapRule> rules;           ///< in order, those for other nodes too
};

/// Takes the sections `--ros-args ... [--]` out of a command line; the program's own arguments stay
/// in `arguments`, in order. Nothing is taken when there is an error. Inside a section stand
///   -r, --remap [NODE:]FROM:=TO         -p, --param [NODE:]NAME:=VALUE   --params-file FILE
///   --log-level [LOGGER:=]LEVEL         -e, --enclave ENCLAVE
///   --log-config-file F, --log-file-name F, --{enable,disable}-{rosout,stdout,external-lib}-logs:
///                                       taken and ignored
/// VALUE is one YAML scalar, no list. LEVEL is debug, info, warn, error or fatal (taken as error)
/// in any case. One for this node's logger (the namespace's tokens and the node's name, joined by
/// dots) or one above it goes before one for all; those for other loggers are ignored.
///
/// Source: ROS 2's design article "ROS Command Line Arguments", and rcl's arguments.c and node.c:
/// the first rule that applies wins; the node is renamed first, so a rule with NODE: before another
/// FROM than __node asks for the new name.
/// Deviation: an unknown word in a section is an error (rcl leaves it to the client library), a
/// rule outside of a section is the program's own word (rcl still takes it, with a warning), and
/// -p NODE:... reaches the node of that name in any namespace (rclcpp: in the root alone).
/// @return kInvalidInput naming the option and what is wrong with its value
Result<RosArguments> take_ros_arguments(std::vector<std::string>& arguments);

/// The full name under which ROS 2 sees a topic or service of this node: `name` (relative, private
/// or absolute) expanded by namespace and node, then the first rule for it applied, once.
/// @return kInvalidInput naming the name and the reason when the result is not a ROS 2 name
Result<std::string> resolve_name(const RosArguments& ros, const std::string& name,
                                 RosNameKind kind);

/// The parameters that a ROS 2 parameters file holds for this node:
///   KEY: {ros__parameters: {NAME: VALUE, GROUP: {NAME: VALUE}}}
/// where KEY is /**, the node's full name, or that with * for a token or ** for any number of them;
/// it may be nested (namespace: {node: ...}). What is for other nodes is not judged.
/// Deviation: rcl lets the last of -p and --params-file hold; ask for the files' parameters first,
/// then for those of -p.
/// @return kUnreadableFile when it cannot be read or is not YAML; kInvalidInput naming file, line
///         and key for a list, a key without value, one given twice, or another layout
Result<RosParameters> read_params_file(const std::filesystem::path& file, const RosArguments& ros);

}  // namespace graspd
