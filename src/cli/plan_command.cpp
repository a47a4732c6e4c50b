#include "commands.hpp"
#include "plan_in_process.hpp"

namespace graspd::cli {

int run_plan(const PlanArguments& arguments, const std::string& config_file,
             const OutputArguments& output) {
    const auto plan = plan_in_process(arguments, config_file);
    if (!plan.ok()) return fail(plan.error());
    return finish(plan.value().reply, plan.value().request.grippers, plan.value().origin, output);
}

}  // namespace graspd::cli
