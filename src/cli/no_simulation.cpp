#include "commands.hpp"

namespace graspd::cli {

int run_simulate(const PlanArguments& /*plan*/, const std::string& /*config_file*/,
                 const SimulateArguments& /*simulate*/, const OutputArguments& /*output*/) {
    return fail(
        {PlanErrorCode::kUnsupported,
         "this build has no simulation: it was configured without, or MuJoCo, EGL, libpng or "
         "giflib was missing (Debian: libmujoco-dev libegl-dev libpng-dev libgif-dev)"});
}

}  // namespace graspd::cli
