#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "close_object.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "graspd/mesh/principal_frame.hpp"
#include "graspd/planner/planner.hpp"
#include "graspd/simulate/render_frames.hpp"
#include "graspd/simulate/simulate_grasp.hpp"
#include "graspd/simulate/write_image.hpp"
#include "plan_in_process.hpp"
#include "write_simulation.hpp"

namespace graspd::cli {
namespace {

constexpr double kFrameInterval_s = 0.08;  // 12.5 pictures a second; GIF counts hundredths

bool draws(const SimulateArguments& arguments) {
    return !arguments.frames.empty() || !arguments.gif.empty();
}

const Gripper& gripper_of(const ProcessPlan& plan, const Grasp& grasp) {
    const auto& grippers = plan.request.grippers;
    const auto named = std::ranges::find(grippers, grasp.gripper_name, &Gripper::name);
    return named == grippers.end() ? grippers.front() : *named;
}

std::optional<PlanError> write_frames(const std::vector<Image>& images,
                                      const std::string& directory) {
    std::error_code ignored;  // a directory that is not there shows when the file is written
    std::filesystem::create_directories(directory, ignored);
    for (std::size_t i = 0; i < images.size(); ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "frame_%04zu.png", i);
        if (auto error = write_png(images[i], std::filesystem::path(directory) / name)) {
            return error;
        }
    }
    return std::nullopt;
}

std::optional<PlanError> write_pictures(const TriangleMesh& mesh_F, const ProcessPlan& plan,
                                        const SimulationRun& run,
                                        const SimulateArguments& arguments) {
    const Grasp& grasp = plan.reply.grasps[run.rank - 1];
    RenderConfig config;
    config.up_F = run.config.up_F.value_or(plan.request.support_plane
                                               ? plan.request.support_plane->normal_F
                                               : Eigen::Vector3d(-grasp.X_FG.linear().col(2)));
    const auto images =
        render_frames(mesh_F, gripper_of(plan, grasp), grasp.width_m, run.result.frames, config);
    if (!images.ok()) return images.error();
    if (!arguments.frames.empty()) {
        if (auto error = write_frames(images.value(), arguments.frames)) return error;
    }
    if (arguments.gif.empty()) return std::nullopt;
    return write_gif(images.value(), kFrameInterval_s, arguments.gif);
}

std::optional<PlanError> write_result(const ProcessPlan& plan, const SimulationRun& run,
                                      const OutputArguments& output) {
    const std::string json =
        write_simulation_json(write_json(plan.reply, plan.request.grippers, plan.origin), run);
    const std::string line = write_simulation_line(plan.reply, run);
    if (auto error = write_report({json, line, {}}, output.report)) return error;
    return write_output(output.format == "json" ? json : line, output.out);
}

}  // namespace

int run_simulate(const PlanArguments& arguments, const std::string& config_file,
                 const SimulateArguments& simulate, const OutputArguments& output) {
    PlanArguments wanted = arguments;
    wanted.top = std::max(wanted.top, simulate.rank);
    const auto planned = plan_in_process(wanted, config_file);
    if (!planned.ok()) return fail(planned.error());
    const ProcessPlan& plan = planned.value();
    if (exit_code(plan.reply) != kExitOk) {
        return finish(plan.reply, plan.request.grippers, plan.origin, output);
    }
    if (simulate.rank > plan.reply.grasps.size()) {
        return fail({PlanErrorCode::kInvalidInput,
                     "--rank = " + std::to_string(simulate.rank) + " must be at most " +
                         std::to_string(plan.reply.grasps.size()) + ", the number of grasps"});
    }
    std::vector<Finding> reported;  // by the plan already
    const auto closed = close_object(plan.request.object_O, plan.config, reported);
    if (!closed.ok()) return fail(closed.error());
    const ConditionedMesh& solid = closed.value().solid;
    const TriangleMesh mesh_F = transformed(plan.request.X_FO, solid.mesh);

    SimulationRun run;
    run.rank = simulate.rank;
    run.config.friction = plan.request.options.friction;
    run.config.grip_force_N = plan.request.options.grip_force_N;
    run.config.mass_kg = object_mass_kg(plan.request.options, solid.volume_m3);
    if (const auto& down_F = plan.request.options.gravity_F) run.config.up_F = -*down_F;
    run.config.frame_interval_s = draws(simulate) ? kFrameInterval_s : 0.0;
    const Grasp& grasp = plan.reply.grasps[run.rank - 1];
    auto result = simulate_grasp(mesh_F, gripper_of(plan, grasp), grasp, plan.request.support_plane,
                                 run.config);
    if (!result.ok()) return fail(result.error());
    run.result = std::move(result).value();

    if (auto error = write_result(plan, run, output)) return fail(*error);
    if (draws(simulate)) {
        if (auto error = write_pictures(mesh_F, plan, run, simulate)) return fail(*error);
    }
    return run.result.verdict == GraspVerdict::kHolds ? kExitOk : kExitNoGrasp;
}

}  // namespace graspd::cli
