#include "dds_settings_of.hpp"

#include "graspd/config/domain_id.hpp"
#include "graspd/config/network_profile.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/config/security.hpp"
#include "graspd/config/wire_names.hpp"

namespace graspd::cli {

Result<DdsSettings> dds_settings_of(const DdsArguments& arguments) {
    const auto domain = choose_domain(arguments.domain);
    if (!domain.ok()) return domain.error();
    const auto profiles = find_profiles();
    if (!profiles.ok()) return profiles.error();
    auto network = choose_network(arguments.profile, profiles.value(), network_environment());
    if (!network.ok()) return network.error();
    RosArguments ros;
    ros.node_namespace = arguments.ros_namespace;
    if (auto error = check_namespace("--namespace", ros.node_namespace)) return *std::move(error);
    auto names = wire_names(ros);
    if (!names.ok()) return names.error();
    auto security = choose_security(ros.enclave, security_variables());
    if (!security.ok()) return security.error();
    DdsSettings settings;
    settings.security = std::move(security).value();
    settings.domain = domain.value();
    settings.profile_file = network.value().profile_file;
    settings.static_peers = network.value().static_peers;
    settings.names = std::move(names).value();
    return settings;
}

}  // namespace graspd::cli
