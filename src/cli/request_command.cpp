#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "commands.hpp"
#include "dds_settings_of.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/version.hpp"
#include "graspd/dds/planner_client.hpp"
#include "progress.hpp"

namespace graspd::cli {
namespace {

using std::chrono::milliseconds;

constexpr double kReplyMargin_ms = 5000.0;    // for discovery and transport, beside the budget
constexpr double kLongestTimeout_ms = 3.6e9;  // a thousand hours, far from the clock's end
constexpr milliseconds kDiscovery{10000};     // three times what a first match was seen to take

/// Differs from that of every other run, so that nobody takes the reply to an earlier one for his.
std::string unique_client_id() {
    std::random_device random;
    return "graspctl-" + std::to_string(::getpid()) + "-" + std::to_string(random());
}

milliseconds timeout_of(const DdsArguments& dds, const PlanArguments& plan) {
    const double ms = dds.timeout_ms > 0 ? dds.timeout_ms : plan.time_budget_ms + kReplyMargin_ms;
    return milliseconds(
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(ms, kLongestTimeout_ms))));
}

Result<PlanReply> ask(const PlanRequest& request, const DdsSettings& settings,
                      const DdsArguments& arguments, milliseconds timeout) {
    auto client = PlannerClient::open(settings, unique_client_id());
    if (!client.ok()) return client.error();
    const double timeout_s = std::chrono::duration<double>(timeout).count();
    Progress shown(progress_on_standard_error(), "looking for a planner", timeout_s);
    // A planner that is being started again is worth as many attempts as one that is silent.
    const std::int64_t attempts = std::int64_t{arguments.retries} + 1;
    const milliseconds patience = std::min(std::min(timeout, kDiscovery) * attempts, kDiscovery);
    if (!client.value()->wait_for_planner(patience)) {
        return PlanError{PlanErrorCode::kNoReply, "no planner on domain " +
                                                      std::to_string(settings.domain) + " within " +
                                                      std::to_string(patience.count()) + " ms"};
    }
    shown.next("waiting for the reply");
    return client.value()->request(request, timeout, arguments.retries);
}

}  // namespace

int run_request(const PlanArguments& arguments, const DdsArguments& dds,
                const OutputArguments& output) {
    using Clock = std::chrono::steady_clock;
    const auto settings = dds_settings_of(dds);
    if (!settings.ok()) return fail(settings.error());
    const auto profiles = find_profiles();
    if (!profiles.ok()) return fail(profiles.error());
    const auto request = make_request(arguments, profiles.value());
    if (!request.ok()) return fail(request.error());

    const auto start = Clock::now();
    const auto reply = ask(request.value(), settings.value(), dds, timeout_of(dds, arguments));
    if (!reply.ok()) return fail(reply.error());
    const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
    return finish(reply.value(), request.value().grippers, {version(), "", taken.count()}, output);
}

}  // namespace graspd::cli
