#include "daemon_man_page.hpp"

#include "command_line/write_man_page.hpp"
#include "graspd/config/version.hpp"

namespace graspd::server {

std::string daemon_man_page(const command_line::CommandEntry& program) {
    command_line::ManPage page{
        "8", std::string("graspd ") + version(), "plans grasps over DDS and ROS 2", {}};
    page.sections = {
        {"DESCRIPTION",
         {{"",
           "graspd takes requests with a mesh or a point cloud and a gripper on the topic "
           "/graspd/grasp_request and by the service /graspd/plan_grasps, and answers each one "
           "once: with ranked grasps, or with the reason why there are none. graspctl request "
           "is a client."},
          {"",
           "It speaks on loopback unless --profile or the environment says otherwise. SIGTERM "
           "and SIGINT stop it within two seconds; requests that wait are answered CANCELLED. "
           "Its log goes to standard error, a line of key=value pairs an event."}}},
        {"EXIT STATUS",
         {{"0", "stopped by a signal, or nothing was to be done"},
          {"1", "a fault of ours, or too many plans did not stop in time"},
          {"2", "a wrong argument, setting or profile, named on standard error"}}},
        {"ENVIRONMENT",
         {{"GRASPD_PROFILES",
           "folder of planner.yaml, gripper and network profiles; default: "
           "../share/graspd/profiles beside the program's own folder"},
          {"ROS_DOMAIN_ID", "DDS domain where --domain is not given"},
          {"ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS",
           "the network where --profile is not given, as ROS 2 means them"},
          {"ROS_SECURITY_ENABLE, ROS_SECURITY_KEYSTORE, ROS_SECURITY_STRATEGY",
           "DDS Security, as ROS 2 means them"}}},
        {"SEE ALSO", {{"", "graspctl(1)"}}}};
    return write_man_page(program, page);
}

}  // namespace graspd::server
