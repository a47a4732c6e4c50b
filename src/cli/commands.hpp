#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "command_line/command_tree.hpp"
#include "output.hpp"
#include "plan_arguments.hpp"

namespace graspd::cli {

/// How long `status` listens by default: a first match can take 3 s, and a planner speaks once a
/// second.
constexpr std::int64_t kStatusWait_ms = 4000;

/// How `request` and `status` reach a daemon.
struct DdsArguments {
    std::optional<std::string> domain;  ///< as typed; absent: ROS_DOMAIN_ID, else 0
    std::string profile;                ///< Fast DDS profiles; empty: by the environment
    std::string ros_namespace = "/";    ///< of the daemon's node
    double timeout_ms = 0.0;            ///< [ms] for each attempt; 0: time budget and some more
    std::uint32_t retries = 3;          ///< on silence and on OVERLOADED
};

/// What `simulate` does with the plan.
struct SimulateArguments {
    std::uint32_t rank = 1;  ///< of the grasp that is executed
    std::string frames;      ///< directory for frame_0000.png and so on; empty: none
    std::string gif;         ///< file for an animation; empty: none
};

/// What `export` takes; docs/exports.md says which option serves which format.
struct ExportArguments {
    std::string file;           ///< a reply's JSON; "-": standard input
    std::string format;         ///< one of kExportFormats
    std::string gripper;        ///< name of a profile, or its file; empty: as the grasps say
    std::uint32_t rank = 0;     ///< of the one grasp to export; 0: all
    std::string object;         ///< its name in the other tool
    std::string link;           ///< name of the link whose pose is written
    std::string eef_transform;  ///< "X,Y,Z,QX,QY,QZ,QW": that link in the mounting frame H [m]
    std::optional<double> object_scale;  ///< from the object file's numbers to metres
    std::optional<double> hand_depth_m;  ///< [m] GPD's hand_depth
};
inline constexpr std::array kExportFormats = {"moveit", "isaac_grasp", "csv", "gpd", "graspgen"};

// One function a subcommand; each returns the exit code (exit_code.hpp). Results go to standard
// output or --out, everything else to standard error.

/// Plans in this process.
int run_plan(const PlanArguments& plan, const std::string& config_file,
             const OutputArguments& output);

/// Plans in this process, then executes one grasp by physics. The exit code is kExitNoGrasp when
/// it does not hold, and kExitUsage in a build without the simulation.
int run_simulate(const PlanArguments& plan, const std::string& config_file,
                 const SimulateArguments& simulate, const OutputArguments& output);

/// Has a daemon plan over DDS. Only in builds with GRASPD_BUILD_DDS.
int run_request(const PlanArguments& plan, const DdsArguments& dds, const OutputArguments& output);

/// Lists the planners that are alive. Only in builds with GRASPD_BUILD_DDS.
int run_status(const DdsArguments& dds, const OutputArguments& output);

/// Plans a recorded request again and prints in what the reply differs from the recorded one. The
/// exit code is kExitOk for the same reply, kExitNoGrasp for another one. Only in builds with
/// GRASPD_BUILD_DDS.
/// @param file  request-000001.cdr; its reply and, where it names an object, that lie beside it
int run_replay(const std::string& file, const std::string& config_file,
               const OutputArguments& output);

/// Prints the concavity of every vertex or point of a file, in the file's order.
/// @param method  any_angle, tetrahedral, or empty: as configured
int run_concavity(const ObjectArguments& object, const std::string& method,
                  const std::string& config_file, const OutputArguments& output);

/// Says what is wrong with a file's mesh or cloud, what the planner repairs, and what would help.
/// @return kExitOk when it can be planned for, kExitUsage when it is refused
int run_doctor(const ObjectArguments& object, const std::string& gripper_name,
               const std::string& config_file, const OutputArguments& output);

/// Writes the grasps of a reply's JSON in the form that another tool reads (write_exports.hpp).
/// @return kExitOk; kExitNoGrasp for a reply without grasps, of which nothing is written
int run_export(const ExportArguments& arguments, const OutputArguments& output);

/// Lists the known grippers.
int run_grippers(const OutputArguments& output);

/// Prints a script that completes graspctl's command line.
/// @param shell  bash or zsh
int run_completion(const command_line::CommandEntry& program, const std::string& shell);

/// Prints graspctl's manual page.
int run_man_page(const command_line::CommandEntry& program);

}  // namespace graspd::cli
