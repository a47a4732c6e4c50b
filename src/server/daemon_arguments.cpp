#include "daemon_arguments.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "graspd/config/load_config.hpp"
#include "graspd/config/version.hpp"

namespace graspd::server {

std::variant<DaemonArguments, int> parse_daemon_arguments(int argc, const char* const* argv) {
    CLI::App app("graspd: plans grasps for whoever publishes an object over DDS");
    DaemonArguments to;
    app.set_version_flag("--version", std::string("graspd ") + version());
    app.add_option("--config", to.config_file, "planner.yaml; default: built-in values");
    app.add_option("--profile", to.profile_file, "Fast DDS profiles; default: loopback only");
    app.add_option("--domain", to.domain, "DDS domain, 0 to 232; default: ROS_DOMAIN_ID, else 0");
    app.add_option("--workers", to.workers, "threads that plan");
    app.add_option("--log-level", to.log_level, "how much goes to standard error")
        ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
    app.add_flag("--print-config", to.print_config, "print the settings in force and leave");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // --help or --version
        app.exit(error, std::cout, std::cerr);
        return asked ? 0 : 2;
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
    config.server.workers = arguments.workers.value_or(config.server.workers);
    if (auto error = validate(config)) return *std::move(error);
    return config;
}

}  // namespace graspd::server
