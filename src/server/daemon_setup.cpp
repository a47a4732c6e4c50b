#include "daemon_setup.hpp"

#include <unistd.h>

#include <array>

#include "graspd/config/domain_id.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/load_moveit_hand.hpp"
#include "graspd/config/network_profile.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/security.hpp"
#include "graspd/config/version.hpp"
#include "graspd/config/wire_names.hpp"
#include "supervisor.hpp"

namespace graspd::server {
namespace {

std::string process_name() {
    std::array<char, 256> host{};
    const bool known = ::gethostname(host.data(), host.size() - 1) == 0;
    return std::string(known ? host.data() : "graspd") + ":" + std::to_string(::getpid());
}

}  // namespace

Result<Setup> read_setup(const DaemonArguments& arguments, const DaemonConfig& config) {
    const auto domain = choose_domain(arguments.domain);
    if (!domain.ok()) return domain.error();
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    auto grippers = load_grippers(profiles.value() / "grippers");
    if (!grippers.ok()) return grippers.error();
    auto hands = load_moveit_hands(profiles.value() / "grippers");
    if (!hands.ok()) return hands.error();
    auto moveit = moveit_settings(config.ros, std::move(hands).value());
    if (!moveit.ok()) return moveit.error();
    auto network = choose_network(arguments.profile_file, profiles.value(), network_environment());
    if (!network.ok()) return network.error();
    auto names = wire_names(arguments.ros);
    if (!names.ok()) return names.error();
    auto security = choose_security(arguments.ros.enclave, security_variables());
    if (!security.ok()) return security.error();
    DdsSettings dds;
    dds.domain = domain.value();
    dds.profile_file = network.value().profile_file;
    dds.static_peers = network.value().static_peers;
    dds.security = std::move(security).value();
    dds.names = std::move(names).value();
    dds.node = ros_node(arguments.ros, config.ros);
    dds.moveit = std::move(moveit).value();
    dds.planner_id = process_name();
    dds.version = version();
    dds.config_hash = config_hash(config.planner);
    dds.max_payload_bytes = config.server.max_payload_bytes;
    dds.limits = {config.planner.condition_mesh.max_vertices,
                  config.planner.condition_mesh.max_faces,
                  config.planner.triangulate_cloud.limit_points, config.server.max_obstacle_faces};
    dds.keep_payloads = !config.server.record_dir.empty();
    dds.markers = config.server.markers_when() != MarkersWhen::kNever;
    dds.watch_peers = config.share.enabled;
    return Setup{config, std::move(dds), network.value().why, std::move(grippers).value(),
                 restarts_from_environment()};
}

}  // namespace graspd::server
