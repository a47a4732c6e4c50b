#include <iostream>

#include "command_line/write_completion.hpp"
#include "command_line/write_man_page.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "graspd/config/version.hpp"

namespace graspd::cli {
namespace {

using namespace command_line;  // NOLINT(google-build-using-namespace): all of it is written here

/// The names in the first column of `graspctl grippers`, below its head.
const std::vector<ListedValues> kListed = {
    {"--gripper", "graspctl grippers 2>/dev/null | sed -n '2,$s/ .*//p'"}};

ManPage man_page() {
    ManPage page{"1", std::string("graspd ") + version(), "plans grasps for unknown objects", {}};
    page.sections = {
        {"FILES AND UNITS",
         {{"",
           "FILE is STL, OBJ, OFF, PLY or PCD, a mesh or a cloud, in metres unless --units or "
           "--scale say otherwise. The result alone goes to standard output, everything else "
           "to standard error."}}},
        {"EXIT STATUS",
         {{"0", "OK, or PARTIAL with grasps; simulate: the grasp holds; replay: the same reply"},
          {"1", "a fault of ours"},
          {"2", "wrong usage or input, INVALID_REQUEST, UNKNOWN_OBJECT, UNKNOWN_GRIPPER"},
          {"3",
           "NO_GRASP, or PARTIAL without grasps; simulate: the grasp does not hold; replay: "
           "another reply"},
          {"4", "no reply, OVERLOADED, CANCELLED"}}},
        {"ENVIRONMENT",
         {{"GRASPD_PROFILES",
           "folder of the gripper and network profiles; default: "
           "../share/graspd/profiles beside the program's own folder"},
          {"ROS_DOMAIN_ID", "DDS domain where --domain is not given"},
          {"ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS",
           "the network where --profile is not given, as ROS 2 means them; default: loopback"}}},
        {"EXAMPLES",
         {{"graspctl plan mug.stl --units mm --gripper robotiq_2f_85 --top 5",
           "the five best grasps, planned in this process"},
          {"graspctl plan table.pcd --scene", "a cloud of a table: grasps for what stands on it"},
          {"source <(graspctl completion bash)", "completion in this shell"}}},
        {"SEE ALSO", {{"", "graspd(8)"}}}};
    return page;
}

}  // namespace

int run_completion(const CommandEntry& program, const std::string& shell) {
    const std::string text = shell == "zsh" ? write_zsh_completion(program, kListed)
                                            : write_bash_completion(program, kListed);
    if (auto error = write_output(text, "")) return fail(*error);
    return kExitOk;
}

int run_man_page(const CommandEntry& program) {
    if (auto error = write_output(write_man_page(program, man_page()), "")) return fail(*error);
    return kExitOk;
}

}  // namespace graspd::cli
