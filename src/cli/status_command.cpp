#include <chrono>

#include "commands.hpp"
#include "dds_settings_of.hpp"
#include "exit_code.hpp"
#include "graspd/dds/status_reader.hpp"
#include "write_status.hpp"

namespace graspd::cli {

int run_status(const DdsArguments& dds, const OutputArguments& output) {
    const auto settings = dds_settings_of(dds);
    if (!settings.ok()) return fail(settings.error());
    const auto wait = std::chrono::milliseconds(
        dds.timeout_ms > 0.0 ? static_cast<std::int64_t>(dds.timeout_ms) : kStatusWait_ms);
    const auto states = read_planner_states(settings.value(), wait);
    if (!states.ok()) return fail(states.error());
    if (states.value().empty()) {
        return fail({PlanErrorCode::kNoReply,
                     "no planner on domain " + std::to_string(settings.value().domain) +
                         " within " + std::to_string(wait.count()) + " ms"});
    }
    const std::string text = output.format == "json" ? write_status_json(states.value())
                                                     : write_status_table(states.value());
    if (auto error = write_output(text, output.out)) return fail(*error);
    return kExitOk;
}

}  // namespace graspd::cli
