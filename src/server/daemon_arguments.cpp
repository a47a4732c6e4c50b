#include "daemon_arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "daemon_man_page.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/version.hpp"

namespace graspd::server {

namespace {

bool is_for_every_node(const std::string& parameter) {
    return parameter == "use_sim_time" || parameter.starts_with("qos_overrides.");
}

}  // namespace

std::variant<DaemonArguments, int> parse_daemon_arguments(int argc, const char* const* argv) {
    CLI::App app("graspd: plans grasps for whoever publishes an object over DDS");
    app.footer("After --ros-args: as for any ROS 2 node (-r, -p, --params-file, --log-level).");
    DaemonArguments to;
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    auto ros = take_ros_arguments(words);
    if (!ros.ok()) {
        std::cerr << "graspd: " << ros.error().detail << '\n';
        return 2;
    }
    to.ros = std::move(ros).value();
    to.log_level = to.ros.log_level.value_or(to.log_level);
    app.set_version_flag("--version", std::string("graspd ") + version());
    app.add_option("--config", to.config_file, "planner.yaml; default: built-in values");
    app.add_option("--profile", to.profile_file, "Fast DDS profiles; default: loopback only");
    app.add_option("--domain", to.domain, "DDS domain, 0 to 232; default: ROS_DOMAIN_ID, else 0");
    app.add_option("--workers", to.workers, "threads that plan");
    app.add_option("--log-level", to.log_level, "how much goes to standard error")
        ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
    app.add_flag("--print-config", to.print_config, "print the settings in force and leave");
    app.add_flag("--supervise", to.supervise,
                 "run the participant as a child and start it again when it crashes");
    bool man_page = false;
    app.add_flag("--man-page", man_page, "print the manual page")->group("");
    try {
        std::ranges::reverse(words);  // as CLI11 wants them
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // --help or --version
        app.exit(error, std::cout, std::cerr);
        return asked ? 0 : 2;
    }
    if (man_page) {
        std::cout << daemon_man_page(command_line::read_command_tree(app, "graspd")) << std::flush;
        return std::cout ? 0 : 1;
    }
    return to;
}

Result<DaemonConfig> daemon_config(const DaemonArguments& arguments) {
    DaemonConfig config;
    if (!arguments.config_file.empty()) {
        auto loaded = load_config<DaemonConfig>(arguments.config_file);
        if (!loaded.ok()) return loaded.error();
        config = std::move(loaded).value();
    }
    RosParameters parameters;
    for (const std::string& file : arguments.ros.params_files) {
        const auto read = read_params_file(file, arguments.ros);
        if (!read.ok()) return read.error();
        parameters.insert(parameters.end(), read.value().begin(), read.value().end());
    }
    const RosParameters& given = arguments.ros.parameters;
    parameters.insert(parameters.end(), given.begin(), given.end());
    for (const auto& [name, value] : parameters) {
        if (is_for_every_node(name)) continue;
        if (auto error = set_parameter(config, name, value)) return *std::move(error);
    }
    config.server.workers = arguments.workers.value_or(config.server.workers);
    if (auto error = validate(config)) return *std::move(error);
    return config;
}

RosNode ros_node(const RosArguments& ros, const RosConfig& config) {
    RosNode node{ros.node_name, ros.node_namespace, ros.enclave, GidBytes::kAuto};
    if (config.gid_bytes == "off") node.gid_bytes = GidBytes::kOff;
    if (config.gid_bytes == "16") node.gid_bytes = GidBytes::k16;
    if (config.gid_bytes == "24") node.gid_bytes = GidBytes::k24;
    return node;
}

Result<MoveItSettings> moveit_settings(const RosConfig& config, std::vector<MoveItHand> hands) {
    MoveItSettings settings;
    if (config.moveit_error_codes == "jazzy") settings.error_codes = MoveItCodes::kJazzy;
    if (config.moveit_error_codes == "humble") settings.error_codes = MoveItCodes::kHumble;
    settings.gripper = config.moveit_gripper;
    settings.hands = std::move(hands);
    std::string known;
    for (const MoveItHand& hand : settings.hands) {
        if (hand.gripper == settings.gripper) return settings;
        known += (known.empty() ? "" : ", ") + hand.gripper;
    }
    if (settings.gripper.empty()) return settings;
    return PlanError{PlanErrorCode::kUnknownGripper, "ros.moveit_gripper = " + settings.gripper +
                                                         " is unknown (known: " + known + ")"};
}

}  // namespace graspd::server
