#include "plan_in_process.hpp"

#include <chrono>

#include "graspd/config/load_config.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/version.hpp"
#include "graspd/planner/planner.hpp"
#include "planner_settings.hpp"

namespace graspd::cli {

Result<ProcessPlan> plan_in_process(const PlanArguments& arguments,
                                    const std::string& config_file) {
    using Clock = std::chrono::steady_clock;
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    auto config = planner_settings(config_file, arguments.concavity);
    if (!config.ok()) return config.error();
    auto request = make_request(arguments, profiles.value());
    if (!request.ok()) return request.error();

    const auto start = Clock::now();
    const std::chrono::duration<double> budget(request.value().options.time_budget_s);
    PlanReply reply =
        plan(request.value(), config.value(), [&] { return Clock::now() - start >= budget; });
    const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
    const ResultOrigin origin{version(), config_hash(config.value()), taken.count()};
    return ProcessPlan{std::move(request).value(), std::move(config).value(), std::move(reply),
                       origin};
}

}  // namespace graspd::cli
