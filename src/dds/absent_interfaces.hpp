#pragma once

#include <string>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

namespace graspd::dds {

/// The addresses that a UDPv4 transport of a participant is limited to (interfaceWhiteList), when
/// no interface of this machine has any of them and is up; separated by commas. Empty when there is
/// no such transport.
///
/// Fast DDS 2.9 binds such a transport to an address of nobody and never looks again: the
/// participant would be deaf and mute for its whole life, also when the interface comes up.
std::string absent_interfaces(const eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace graspd::dds
