#pragma once

#include <optional>
#include <string>

#include "graspd/base/result.hpp"
#include "graspd/base/security_enclave.hpp"

namespace graspd {

/// ROS 2's variables about security; absent when unset or empty.
struct SecurityVariables {
    std::optional<std::string> enable = std::nullopt;    ///< ROS_SECURITY_ENABLE
    std::optional<std::string> strategy = std::nullopt;  ///< ROS_SECURITY_STRATEGY
    std::optional<std::string> keystore = std::nullopt;  ///< ROS_SECURITY_KEYSTORE
    std::optional<std::string> enclave = std::nullopt;   ///< ROS_SECURITY_ENCLAVE_OVERRIDE
};

/// This process's variables. Not to be called while another thread changes the environment.
SecurityVariables security_variables();

/// The enclave that this process is to join with; nothing: without security.
///
/// ROS_SECURITY_ENABLE = true turns security on; the files lie in KEYSTORE/enclaves/ENCLAVE, where
/// ROS_SECURITY_ENCLAVE_OVERRIDE goes before the enclave of --ros-args. With the strategy
/// Permissive (the default) a missing enclave means no security, with Enforce it is an error; a
/// file missing from an enclave that is there always is one.
///
/// Source: rcl's security.c. Deviation: a value of ROS_SECURITY_ENABLE or _STRATEGY that ROS 2 does
/// not know is an error, because ROS 2 then runs without security and does not say so; a half
/// enclave is an error under Permissive too.
/// @param enclave  absolute, such as "/graspd"
/// @return kInvalidInput naming the variable and its value, kUnreadableFile naming the file
Result<std::optional<SecurityEnclave>> choose_security(const std::string& enclave,
                                                       const SecurityVariables& variables);

}  // namespace graspd
