#pragma once

#include <string>

namespace graspd {

/// Where the files lie by which a participant proves who it is and what it may do (DDS
/// Security 1.1); the names are those of a ROS 2 keystore.
struct SecurityEnclave {
    std::string identity_ca;     ///< identity_ca.cert.pem: who signs identities
    std::string certificate;     ///< cert.pem
    std::string private_key;     ///< key.pem
    std::string permissions_ca;  ///< permissions_ca.cert.pem: who signs the two below
    std::string governance;      ///< governance.p7s: what is protected, and how
    std::string permissions;     ///< permissions.p7s: which topics this identity may read and write
};

}  // namespace graspd
