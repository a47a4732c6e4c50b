#include <iostream>
#include <utility>

#include "commands.hpp"
#include "exit_code.hpp"
#include "plan_in_process.hpp"
#include "report_data.hpp"
#include "report_pictures.hpp"
#include "write_report.hpp"

namespace graspd::cli {
namespace {

/// The report's pictures, where this machine can draw. @return the exit code, by default `code`
int draw(const ProcessPlan& plan, const PlanTrace& trace, const std::string& directory, int code) {
    if (code == kExitInternal) return code;
    const auto error = write_report_pictures(plan, trace, directory);
    if (!error) return code;
    if (error->code != PlanErrorCode::kUnsupported) return fail(*error);
    std::cerr << "graspctl: no pictures in the report: " << error->detail << '\n';
    return code;
}

}  // namespace

int run_plan(const PlanArguments& arguments, const std::string& config_file,
             const OutputArguments& output) {
    const bool with_page = !output.report.empty();
    PlanTrace trace;
    const auto plan = plan_in_process(arguments, config_file, with_page ? &trace : nullptr);
    if (!plan.ok()) return fail(plan.error());
    std::string page;
    if (with_page) {
        page =
            report_page(report_template(), report_data(plan.value(), trace, arguments.object.file));
    }
    const int code = finish(plan.value().reply, plan.value().request.grippers, plan.value().origin,
                            output, std::move(page));
    return with_page ? draw(plan.value(), trace, output.report, code) : code;
}

}  // namespace graspd::cli
