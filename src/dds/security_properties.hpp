#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "graspd/base/security_enclave.hpp"

namespace graspd::dds {

/// Makes a participant prove its identity and keep to its permissions: DDS Security's built-in
/// plugins for authentication, access control and encryption.
void set_security(const SecurityEnclave& enclave,
                  eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace graspd::dds
