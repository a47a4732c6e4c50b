#include "plan_in_process.hpp"

#include <chrono>

#include "graspd/config/load_config.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/version.hpp"
#include "plan_scene.hpp"
#include "planner_settings.hpp"
#include "progress.hpp"

namespace graspd::cli {
namespace {

/// The object of a file, or one of a scene's.
Result<ScenePlan> plan_object(const PlanArguments& arguments, PlanRequest request,
                              const PlannerConfig& config, const StopQuery& stop,
                              PlanTrace* trace) {
    if (!arguments.scene) {
        PlanReply reply = plan(request, config, stop, trace);
        return ScenePlan{std::move(request), std::move(reply)};
    }
    std::optional<Eigen::Vector3d> place;
    if (!arguments.object_at.empty()) {
        const auto parsed = parse_place("--object-at", arguments.object_at);
        if (!parsed.ok()) return parsed.error();
        place = parsed.value();
    }
    return plan_scene(request, place, config, stop, trace);
}

}  // namespace

Result<ProcessPlan> plan_in_process(const PlanArguments& arguments, const std::string& config_file,
                                    PlanTrace* trace) {
    using Clock = std::chrono::steady_clock;
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    auto config = planner_settings(config_file, arguments.concavity);
    if (!config.ok()) return config.error();
    std::vector<Finding> read;
    auto request = make_request(arguments, profiles.value(), &read);
    if (!request.ok()) return request.error();

    const auto start = Clock::now();
    const std::chrono::duration<double> budget(request.value().options.time_budget_s);
    const StopQuery stop = [&] { return Clock::now() - start >= budget; };
    const Progress shown(progress_on_standard_error(), "planning", budget.count());
    auto planned = plan_object(arguments, std::move(request).value(), config.value(), stop, trace);
    if (!planned.ok()) return planned.error();
    PlanReply& reply = planned.value().reply;
    const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
    std::vector<Finding>& findings = reply.report.findings;
    findings.insert(findings.begin(), read.begin(), read.end());
    const ResultOrigin origin{version(), config_hash(config.value()), taken.count()};
    return ProcessPlan{std::move(planned.value().request), std::move(config).value(),
                       std::move(reply), origin};
}

}  // namespace graspd::cli
