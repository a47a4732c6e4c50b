#include "commands.hpp"
#include "report_pictures.hpp"

namespace graspd::cli {
namespace {

PlanError unsupported(const std::string& what) {
    return {PlanErrorCode::kUnsupported,
            "this build " + what +
                ": it was configured without, or MuJoCo, EGL, libpng or giflib " +
                "was missing (Debian: libmujoco-dev libegl-dev libpng-dev libgif-dev)"};
}

}  // namespace

int run_simulate(const PlanArguments& /*plan*/, const std::string& /*config_file*/,
                 const SimulateArguments& /*simulate*/, const OutputArguments& /*output*/) {
    return fail(unsupported("has no simulation"));
}

std::optional<PlanError> write_report_pictures(const ProcessPlan& /*plan*/,
                                               const PlanTrace& /*trace*/,
                                               const std::string& /*directory*/) {
    return unsupported("draws no pictures");
}

}  // namespace graspd::cli
