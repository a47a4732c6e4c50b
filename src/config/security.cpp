#include "graspd/config/security.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "graspd/config/ros_names.hpp"
#include "refused.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnable = "ROS_SECURITY_ENABLE";
constexpr const char* kStrategy = "ROS_SECURITY_STRATEGY";
constexpr const char* kKeystore = "ROS_SECURITY_KEYSTORE";
constexpr const char* kEnclave = "ROS_SECURITY_ENCLAVE_OVERRIDE";

std::optional<std::string> variable(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    if (value == nullptr || *value == '\0') return std::nullopt;
    return value;
}

bool is_readable(const fs::path& file) {
    std::error_code failed;
    return fs::is_regular_file(file, failed) && std::ifstream(file).good();
}

/// Whether it is a folder. An error where that cannot be seen (no permission to look): taken for
/// "no", a Permissive node would run without security.
Result<bool> is_folder(const fs::path& path) {
    std::error_code failed;
    const fs::file_status status = fs::status(path, failed);
    if (status.type() == fs::file_type::none) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         "security keystore: " + path.string() + ": " + failed.message()};
    }
    return fs::is_directory(status);
}

/// @param said  a variable of two values. @return whether it has the second one
Result<bool> second_of(const char* name, const std::optional<std::string>& said,
                       const std::pair<const char*, const char*>& values, const char* must) {
    if (!said || *said == values.first) return false;
    if (*said == values.second) return true;
    return refused(name, *said, must);
}

Result<std::optional<SecurityEnclave>> read_enclave(const fs::path& folder) {
    SecurityEnclave enclave;
    for (const auto& [member, name] : {
             std::pair{&enclave.identity_ca, "identity_ca.cert.pem"},
             std::pair{&enclave.certificate, "cert.pem"},
             std::pair{&enclave.private_key, "key.pem"},
             std::pair{&enclave.permissions_ca, "permissions_ca.cert.pem"},
             std::pair{&enclave.governance, "governance.p7s"},
             std::pair{&enclave.permissions, "permissions.p7s"},
         }) {
        const fs::path file = folder / name;
        if (!is_readable(file)) {
            return PlanError{PlanErrorCode::kUnreadableFile,
                             "security enclave " + folder.string() + " has no readable " + name};
        }
        *member = file.string();
    }
    return std::optional(std::move(enclave));
}

}  // namespace

SecurityVariables security_variables() {
    return {variable(kEnable), variable(kStrategy), variable(kKeystore), variable(kEnclave)};
}

Result<std::optional<SecurityEnclave>> choose_security(const std::string& enclave,
                                                       const SecurityVariables& variables) {
    const auto enabled =
        second_of(kEnable, variables.enable, {"false", "true"}, "must be true or false");
    if (!enabled) return enabled.error();
    if (!enabled.value()) return std::optional<SecurityEnclave>();
    const auto enforced = second_of(kStrategy, variables.strategy, {"Permissive", "Enforce"},
                                    "must be Enforce or Permissive");
    if (!enforced) return enforced.error();
    const std::string chosen = variables.enclave.value_or(enclave);
    if (auto bad = check_enclave(kEnclave, chosen)) return *std::move(bad);
    const auto keystore = is_folder(variables.keystore.value_or(""));
    if (!keystore) return keystore.error();
    if (!keystore.value()) {
        return refused(kKeystore, variables.keystore.value_or("(unset)"),
                       "is no folder, and ROS_SECURITY_ENABLE is true");
    }
    fs::path folder = fs::path(*variables.keystore) / "enclaves";
    if (chosen != "/") folder /= chosen.substr(1);
    const auto present = is_folder(folder);
    if (!present) return present.error();
    if (!present.value() && !enforced.value()) return std::optional<SecurityEnclave>();
    std::error_code failed;
    const fs::path absolute = fs::absolute(folder, failed);
    return read_enclave(failed ? folder : absolute);
}

}  // namespace graspd
