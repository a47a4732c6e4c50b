#include <algorithm>

#include "graspd/config/load_config.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/ros_arguments.hpp"
#include "server_config.hpp"
#include "targets.hpp"

namespace graspd::fuzz {
namespace {

bool check_refusal(const PlanError& error) {
    require(!error.detail.empty(), "a refusal says why");
    require(error.code == PlanErrorCode::kInvalidInput ||
                error.code == PlanErrorCode::kUnreadableFile ||
                error.code == PlanErrorCode::kDegenerate || error.code == PlanErrorCode::kTooLarge,
            "a text is not our fault: " + error.detail);
    return false;
}

/// Groups of every type of value. All of planner.yaml's would take thirty times as long and read no
/// byte in another way.
struct SomeConfig {
    SearchConfig search;
    VertexConcavityConfig vertex_concavity;
    server::ServerConfig server;
    server::RosConfig ros;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("search", self.search);
        visit("vertex_concavity", self.vertex_concavity);
        visit("server", self.server);
        visit("ros", self.ros);
    }
};

/// What was loaded is within its ranges, and the same when it is printed and loaded again.
template <class Settings>
bool take_config(Bytes text) {
    static const ScratchFile file("planner.yaml");
    static const ScratchFile printed_file("printed.yaml");
    const auto loaded = load_config<Settings>(file.write(text));
    if (!loaded.ok()) return check_refusal(loaded.error());
    require(!validate<Settings>(loaded.value()).has_value(), "a loaded value is in its range");
    const std::string printed = print_config(loaded.value());
    const auto again = load_config<Settings>(printed_file.write(
        {reinterpret_cast<const std::uint8_t*>(printed.data()), printed.size()}));
    require(again.ok(), "printed settings load: " + (again ? "" : again.error().detail));
    require(print_config(again.value()) == printed, "printed settings load as they were");
    return true;
}

bool check_gripper(const Result<Gripper>& loaded) {
    if (!loaded.ok()) return check_refusal(loaded.error());
    const Gripper& gripper = loaded.value();
    require(!validate(gripper).has_value(), "a loaded gripper is valid");
    require(!gripper.name.empty() && gripper.name.size() <= 64, "a loaded gripper has a name");
    for (const double opening_m : {gripper.min_width_m, gripper.max_width_m}) {
        require(grasp_in_hand(gripper, opening_m).matrix().allFinite(), "a hand has a grasp frame");
        require(gripper_parts(gripper, opening_m, opening_m).size() == 3, "a gripper has 3 boxes");
        placed_parts(gripper, opening_m, opening_m);
    }
    return true;
}

bool take_gripper(Bytes text) {
    static const ScratchFile file("gripper.yaml");
    return check_gripper(load_gripper(file.write(text)));
}

constexpr std::string_view kUrdfProfile = R"(name: fuzzed
urdf: hand.urdf
mount_link: base
driver_joint: left_joint
open: 0.0
closed: 0.04
palm_links: [base]
left_links: [left]
right_links: [right]
left_pad: {link: left, point: [-0.0425, 0, 0.05]}
right_pad: {link: right, point: [0.0425, 0, 0.05]}
pad_width: 0.02
pad_height: 0.03
)";

bool take_urdf(Bytes text) {
    static const ScratchFile urdf("hand.urdf");
    static const ScratchFile profile("hand.yaml");
    profile.write(
        {reinterpret_cast<const std::uint8_t*>(kUrdfProfile.data()), kUrdfProfile.size()});
    urdf.write(text);
    return check_gripper(load_gripper(profile.path()));
}

/// Lines as the words of a command line.
bool take_arguments(Bytes text) {
    std::vector<std::string> words;
    std::string_view rest = text_of(text);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        words.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const auto before = words;
    const auto ros = take_ros_arguments(words);
    if (!ros.ok()) {
        require(words == before, "nothing is taken when there is an error");
        return check_refusal(ros.error());
    }
    require(words.size() <= before.size(), "words are taken, not added");
    require(!check_node_name("name", ros.value().node_name), "a node's name is one");
    require(!check_namespace("namespace", ros.value().node_namespace), "a namespace is one");
    for (const char* name : {"~/status", "grasp_request", "/diagnostics"}) {
        for (const auto kind : {RosNameKind::kTopic, RosNameKind::kService}) {
            const auto full = resolve_name(ros.value(), name, kind);
            if (!full.ok()) check_refusal(full.error());
            if (full.ok()) require(full.value().starts_with('/'), "a full name is absolute");
        }
    }
    server::ServerConfig config;
    for (const auto& [name, value] : ros.value().parameters) {
        if (const auto bad = set_parameter(config, name, value)) return check_refusal(*bad);
    }
    return true;
}

bool take_params_file(Bytes text) {
    static const ScratchFile file("params.yaml");
    const auto read = read_params_file(file.write(text), {});
    if (!read.ok()) return check_refusal(read.error());
    SomeConfig config;
    for (const auto& [name, value] : read.value()) {
        if (const auto bad = set_parameter(config, name, value)) return check_refusal(*bad);
    }
    return true;
}

}  // namespace

bool fuzz_yaml(Bytes bytes) {
    if (bytes.empty()) return false;
    const Bytes text = bytes.subspan(1);
    switch (bytes[0]) {
        case 'd': return take_config<SomeConfig>(text);
        case 's': return take_config<server::ServerConfig>(text);
        case 'g': return take_gripper(text);
        case 'u': return take_urdf(text);
        case 'a': return take_arguments(text);
        case 'p': return take_params_file(text);
        default: return false;
    }
}

}  // namespace graspd::fuzz
