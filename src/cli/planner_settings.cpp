#include "planner_settings.hpp"

#include "graspd/config/load_config.hpp"

namespace graspd::cli {

Result<PlannerConfig> planner_settings(const std::string& config_file,
                                       const std::string& concavity_method) {
    PlannerConfig config;
    if (!config_file.empty()) {
        auto loaded =
            load_config<PlannerConfig>(config_file, {}, {"server", "share", "ros", "supervisor"});
        if (!loaded.ok()) return loaded.error();
        config = std::move(loaded).value();
    }
    if (!concavity_method.empty()) config.vertex_concavity.method = concavity_method;
    return config;
}

}  // namespace graspd::cli
