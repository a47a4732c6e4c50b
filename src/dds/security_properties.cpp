#include "security_properties.hpp"

namespace graspd::dds {

void set_security(const SecurityEnclave& enclave,
                  eprosima::fastdds::dds::DomainParticipantQos& qos) {
    auto& properties = qos.properties().properties();
    const auto set = [&](const char* name, const std::string& value) {
        properties.emplace_back(name, value);
    };
    const auto set_file = [&](const char* name, const std::string& file) {
        set(name, "file://" + file);
    };
    set("dds.sec.auth.plugin", "builtin.PKI-DH");
    set_file("dds.sec.auth.builtin.PKI-DH.identity_ca", enclave.identity_ca);
    set_file("dds.sec.auth.builtin.PKI-DH.identity_certificate", enclave.certificate);
    set_file("dds.sec.auth.builtin.PKI-DH.private_key", enclave.private_key);
    set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
    set("dds.sec.access.plugin", "builtin.Access-Permissions");
    set_file("dds.sec.access.builtin.Access-Permissions.permissions_ca", enclave.permissions_ca);
    set_file("dds.sec.access.builtin.Access-Permissions.governance", enclave.governance);
    set_file("dds.sec.access.builtin.Access-Permissions.permissions", enclave.permissions);
}

}  // namespace graspd::dds
