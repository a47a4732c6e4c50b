#include <chrono>

#include "commands.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/version.hpp"
#include "graspd/planner/planner.hpp"
#include "planner_settings.hpp"

namespace graspd::cli {

int run_plan(const PlanArguments& arguments, const std::string& config_file,
             const OutputArguments& output) {
    using Clock = std::chrono::steady_clock;
    const auto profiles = find_profiles();
    if (!profiles.ok()) return fail(profiles.error());
    const auto config = planner_settings(config_file, arguments.concavity);
    if (!config.ok()) return fail(config.error());
    const auto request = make_request(arguments, profiles.value());
    if (!request.ok()) return fail(request.error());

    const auto start = Clock::now();
    const std::chrono::duration<double> budget(request.value().options.time_budget_s);
    const PlanReply reply =
        plan(request.value(), config.value(), [&] { return Clock::now() - start >= budget; });
    const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
    return finish(reply, request.value().grippers,
                  {version(), config_hash(config.value()), taken.count()}, output);
}

}  // namespace graspd::cli
