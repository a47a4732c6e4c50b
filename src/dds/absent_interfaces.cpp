#include "absent_interfaces.hpp"

#include <algorithm>
#include <vector>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPFinder.h>

namespace graspd::dds {
namespace {

using eprosima::fastrtps::rtps::IPFinder;

/// As the middleware sees them: of interfaces that run alone, loopback's too.
std::vector<IPFinder::info_IP> addresses_here() {
    std::vector<IPFinder::info_IP> here;
    IPFinder::getIPs(&here, true);
    return here;
}

}  // namespace

std::string absent_interfaces(const eprosima::fastdds::dds::DomainParticipantQos& qos) {
    const auto here = addresses_here();
    const auto is_here = [&](const std::string& address) {
        return std::ranges::count(here, address, &IPFinder::info_IP::name) > 0;
    };
    for (const auto& transport : qos.transport().user_transports) {
        const auto* udp =
            dynamic_cast<const eprosima::fastdds::rtps::UDPv4TransportDescriptor*>(transport.get());
        if (udp == nullptr || udp->interfaceWhiteList.empty()) continue;
        if (std::ranges::any_of(udp->interfaceWhiteList, is_here)) continue;
        std::string absent;
        for (const std::string& address : udp->interfaceWhiteList) {
            absent += (absent.empty() ? "" : ", ") + address;
        }
        return absent;
    }
    return {};
}

}  // namespace graspd::dds
