#include <CLI/CLI.hpp>
#include <iostream>

#include "commands.hpp"
#include "exit_code.hpp"
#include "graspd/concavity/vertex_concavity.hpp"
#include "graspd/config/version.hpp"

namespace {

using namespace graspd::cli;  // NOLINT(google-build-using-namespace): this is its program

/// Everything that the command line can set.
struct Arguments {
    PlanArguments plan;
    OutputArguments output;
    DdsArguments dds;
    SimulateArguments simulate;
    ExportArguments exports;
    std::string units;
    std::string config_file;
    std::string method;  ///< of `concavity`; empty: as configured
    std::string shell;   ///< of `completion`
};

const std::vector<std::string> kMethods(graspd::kConcavityMethods.begin(),
                                        graspd::kConcavityMethods.end());

void add_object(CLI::App& command, Arguments& to) {
    command.add_option("FILE", to.plan.object.file, "STL, OBJ, OFF, PLY or PCD")->required();
    auto* scale = command.add_option("--scale", to.plan.object.scale,
                                     "factor from the file's numbers to metres");
    scale->check(CLI::PositiveNumber);
    command.add_option("--units", to.units, "unit of the file's numbers")
        ->check(CLI::IsMember({"mm", "cm", "m"}))
        ->excludes(scale);
}

void add_sensor(CLI::App& command, Arguments& to) {
    command.add_option("--sensor", to.plan.object.sensor,
                       "X,Y,Z [m]: where the sensor of a one-sided cloud stood");
}

void add_output(CLI::App& command, Arguments& to) {
    command.add_option("--out", to.output.out, "write the result to this file");
}

void add_format(CLI::App& command, Arguments& to) {
    command.add_option("--format", to.output.format, "table (for people) or json")
        ->check(CLI::IsMember({"table", "json"}));
    add_output(command, to);
}

void add_config(CLI::App& command, Arguments& to) {
    command.add_option("--config", to.config_file, "planner.yaml; default: built-in values");
}

void add_plan(CLI::App& command, Arguments& to) {
    add_object(command, to);
    add_format(command, to);
    add_sensor(command, to);
    command.add_option("--gripper", to.plan.gripper, "name of a profile, or a .yaml file");
    command.add_option("--top", to.plan.top, "most grasps")->check(CLI::Range(1u, 1000000u));
    command.add_option("--time-budget", to.plan.time_budget_ms, "[ms]")->check(CLI::PositiveNumber);
    command.add_option("--friction", to.plan.friction, "coefficient")->check(CLI::PositiveNumber);
    command.add_option("--up", to.plan.up, "X,Y,Z: the object stands on a plane normal to this");
    command.add_option("--gravity", to.plan.gravity,
                       "X,Y,Z: its direction, or none; default: against --up, else 0,0,-1");
    command.add_option("--sources", to.plan.sources, "boundary,wall,whole_object or all");
    command.add_flag("--suggest", to.plan.suggest,
                     "say what would help, also when there are grasps");
    command.add_option("--seed", to.plan.seed, "of every random draw");
    command.add_option("--frame", to.plan.frame_id, "name of the file's frame, echoed");
    command.add_option("--report", to.output.report,
                       "directory for reply.json and reply.txt; plan: also report.html, pictures");
}

/// What plans in this process takes.
void add_plan_here(CLI::App& command, Arguments& to) {
    add_plan(command, to);
    add_config(command, to);
    command.add_option("--concavity", to.plan.concavity, "how concavity is computed")
        ->check(CLI::IsMember(kMethods));
    auto* scene = command.add_flag("--scene", to.plan.scene,
                                   "FILE is a cloud of a table: plan for what stands on it");
    command
        .add_option("--object-at", to.plan.object_at,
                    "X,Y,Z [m]: the object of the scene that is nearest; default: the best one")
        ->needs(scene);
}

void add_simulate(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* simulate = app.add_subcommand("simulate", "plan, then execute a grasp by physics");
    add_plan_here(*simulate, to);
    simulate->add_option("--rank", to.simulate.rank, "which grasp; default: the best")
        ->check(CLI::Range(1u, 1000000u));
    simulate->add_option("--frames", to.simulate.frames, "directory for pictures (PNG)");
    simulate->add_option("--gif", to.simulate.gif, "file for an animation");
    simulate->callback([&] {
        run = [&] { return run_simulate(to.plan, to.config_file, to.simulate, to.output); };
    });
}

#ifdef GRASPD_WITH_DDS
void add_dds(CLI::App& command, Arguments& to) {
    command.add_option("--domain", to.dds.domain, "DDS domain; default: ROS_DOMAIN_ID, else 0");
    command.add_option("--profile", to.dds.profile,
                       "Fast DDS profiles; default: loopback, unless ROS_AUTOMATIC_DISCOVERY_RANGE "
                       "or ROS_LOCALHOST_ONLY says otherwise");
    command.add_option("--namespace", to.dds.ros_namespace, "of the daemon's node, such as /cell1");
}

void add_status(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* status = app.add_subcommand("status", "list the planners that are alive");
    add_dds(*status, to);
    add_format(*status, to);
    status->add_option("--timeout", to.dds.timeout_ms, "[ms] how long to listen; default: 4000")
        ->check(CLI::PositiveNumber);
    status->callback([&] { run = [&] { return run_status(to.dds, to.output); }; });
}

void add_replay(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* replay = app.add_subcommand("replay", "plan a recorded request again and compare");
    replay->add_option("FILE", to.plan.object.file, "request-000001.cdr of server.record_dir")
        ->required();
    add_config(*replay, to);
    add_format(*replay, to);
    replay->callback(
        [&] { run = [&] { return run_replay(to.plan.object.file, to.config_file, to.output); }; });
}

void add_request(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* request = app.add_subcommand("request", "have a running graspd plan, over DDS");
    add_plan(*request, to);
    add_dds(*request, to);
    request->add_option("--timeout", to.dds.timeout_ms, "[ms] for each attempt")
        ->check(CLI::PositiveNumber);
    request->add_option("--retries", to.dds.retries, "attempts after the first");
    request->add_flag("--markers", to.plan.markers,
                      "have graspd draw the plan on /graspd/markers, for RViz or Foxglove");
    request->callback([&] { run = [&] { return run_request(to.plan, to.dds, to.output); }; });
}
#endif

const std::vector<std::string> kFormats(kExportFormats.begin(), kExportFormats.end());

void add_export(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* command = app.add_subcommand("export", "write a reply's grasps for another tool");
    ExportArguments& arguments = to.exports;
    command->add_option("GRASPS", arguments.file, "JSON of --format json; -: standard input")
        ->required();
    command->add_option("--format", arguments.format, "what the grasps are written for")
        ->required()
        ->check(CLI::IsMember(kFormats));
    command->add_option("-o,--out", to.output.out, "write the result to this file");
    command->add_option("--rank", arguments.rank, "export this grasp alone; default: all")
        ->check(CLI::Range(1u, 1000000u));
    command->add_option("--gripper", arguments.gripper,
                        "name of a profile, or a file; default: the profile that the grasps name");
    command->add_option("--object", arguments.object,
                        "its name there: collision object, object frame, or mesh file (graspgen)");
    auto* link = command->add_option(
        "--link", arguments.link, "name of the link whose pose is written (moveit, isaac_grasp)");
    command
        ->add_option("--eef-transform", arguments.eef_transform,
                     "X,Y,Z,QX,QY,QZ,QW [m]: pose of that link in the gripper's mounting frame H")
        ->needs(link);
    command
        ->add_option("--object-scale", arguments.object_scale,
                     "from the object file's numbers to metres (isaac_grasp, graspgen)")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--hand-depth", arguments.hand_depth_m,
                     "[m] hand_depth of GPD's settings; default: the fingers' length (gpd)")
        ->check(CLI::PositiveNumber);
    command->footer(
        "Examples:\n"
        "  graspctl plan mug.ply --gripper franka_hand --format json --out grasps.json\n"
        "  graspctl export grasps.json --format moveit --object mug -o grasps.yaml\n"
        "  graspctl export grasps.json --format moveit --rank 1 --link tool0 "
        "--eef-transform=0,0,-0.1,0,0,0,1\n"
        "  graspctl plan mug.ply --format json | graspctl export - --format csv");
    command->callback([&] { run = [&] { return run_export(to.exports, to.output); }; });
}

void add_doctor(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* doctor =
        app.add_subcommand("doctor", "what is wrong with a mesh or cloud, what was repaired");
    add_object(*doctor, to);
    add_format(*doctor, to);
    add_config(*doctor, to);
    add_sensor(*doctor, to);
    doctor->add_option("--gripper", to.plan.gripper, "name of a profile, or a file");
    doctor->callback([&] {
        run = [&] {
            return run_doctor(to.plan.object, to.plan.gripper, to.config_file, to.output);
        };
    });
}

/// What is written from the description of the other subcommands. `app` outlives `run`.
void add_shell(CLI::App& app, Arguments& to, std::function<int()>& run) {
    const auto tree = [&] { return graspd::command_line::read_command_tree(app, "graspctl"); };
    auto* completion = app.add_subcommand("completion", "print a script that completes graspctl");
    completion->add_option("SHELL", to.shell, "for which shell")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh"}));
    completion->callback(
        [&, tree] { run = [&, tree] { return run_completion(tree(), to.shell); }; });
    auto* man_page = app.add_subcommand("man-page", "print the manual page")->group("");
    man_page->callback([&, tree] { run = [tree] { return run_man_page(tree()); }; });
}

/// Adds the subcommands; each sets `run` to what it stands for.
void add_commands(CLI::App& app, Arguments& to, std::function<int()>& run) {
    auto* plan = app.add_subcommand("plan", "plan grasps in this process");
    add_plan_here(*plan, to);
    plan->callback([&] { run = [&] { return run_plan(to.plan, to.config_file, to.output); }; });
    add_simulate(app, to, run);
#ifdef GRASPD_WITH_DDS
    add_replay(app, to, run);
    add_request(app, to, run);
    add_status(app, to, run);
#endif
    auto* concavity =
        app.add_subcommand("concavity", "one line a vertex or point as stored: index value_m flag");
    add_object(*concavity, to);
    add_output(*concavity, to);
    add_config(*concavity, to);
    concavity->add_option("--method", to.method, "how it is computed; default: as configured")
        ->check(CLI::IsMember(kMethods));
    concavity->callback([&] {
        run = [&] { return run_concavity(to.plan.object, to.method, to.config_file, to.output); };
    });

    add_doctor(app, to, run);
    add_export(app, to, run);
    auto* grippers = app.add_subcommand("grippers", "list the known grippers");
    add_format(*grippers, to);
    grippers->callback([&] { run = [&] { return run_grippers(to.output); }; });
    add_shell(app, to, run);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("graspctl: plans grasps for objects it has never seen");
    app.set_version_flag("--version", std::string("graspctl ") + graspd::version());
    app.require_subcommand(1);
    Arguments arguments;
    std::function<int()> run;
    add_commands(app, arguments, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // --help or --version
        app.exit(error, std::cout, std::cerr);
        return asked ? kExitOk : kExitUsage;
    }
    if (arguments.units == "mm") arguments.plan.object.scale = 1e-3;
    if (arguments.units == "cm") arguments.plan.object.scale = 1e-2;
    try {
        return run();
    } catch (const std::exception& error) {
        return fail({graspd::PlanErrorCode::kInternal, error.what()});
    }
}
