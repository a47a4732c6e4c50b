#include "graspd/config/security.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace graspd {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::array kFiles = {"identity_ca.cert.pem",    "cert.pem",       "key.pem",
                               "permissions_ca.cert.pem", "governance.p7s", "permissions.p7s"};

/// A keystore with the enclaves /arm and /cell/arm, whose files are empty.
class ConfigSecurity : public testing::Test {
protected:
    ConfigSecurity() {
        for (const char* enclave : {"arm", "cell/arm"}) {
            const fs::path folder = keystore_ / "enclaves" / enclave;
            fs::create_directories(folder);
            for (const char* file : kFiles) std::ofstream(folder / file) << "x";
        }
    }
    ~ConfigSecurity() override { fs::remove_all(keystore_); }

    SecurityVariables enforced() const { return {"true", "Enforce", keystore_.string(), {}}; }
    static std::string error_of(const std::string& enclave, const SecurityVariables& variables) {
        const auto chosen = choose_security(enclave, variables);
        return chosen.ok() ? "none" : chosen.error().detail;
    }

    const fs::path keystore_ =
        fs::temp_directory_path() / ("graspd_config_security_" + std::to_string(::getpid()));
};

TEST_F(ConfigSecurity, IsOffUnlessItIsAskedFor) {
    for (const std::optional<std::string>& enable :
         {std::optional<std::string>(), std::optional<std::string>("false")}) {
        const auto chosen = choose_security("/arm", {enable, "Enforce", keystore_.string(), {}});
        ASSERT_TRUE(chosen.ok()) << chosen.error().detail;
        EXPECT_FALSE(chosen.value().has_value());
    }
}

TEST_F(ConfigSecurity, TakesTheFilesOfItsEnclave) {
    const auto chosen = choose_security("/cell/arm", enforced());
    ASSERT_TRUE(chosen.ok()) << chosen.error().detail;
    ASSERT_TRUE(chosen.value().has_value());
    const SecurityEnclave& files = *chosen.value();
    const std::string folder = (keystore_ / "enclaves/cell/arm/").string();
    EXPECT_EQ(files.identity_ca, folder + "identity_ca.cert.pem");
    EXPECT_EQ(files.certificate, folder + "cert.pem");
    EXPECT_EQ(files.private_key, folder + "key.pem");
    EXPECT_EQ(files.permissions_ca, folder + "permissions_ca.cert.pem");
    EXPECT_EQ(files.governance, folder + "governance.p7s");
    EXPECT_EQ(files.permissions, folder + "permissions.p7s");
}

TEST_F(ConfigSecurity, TheOverrideGoesBeforeTheEnclaveOfTheNode) {
    SecurityVariables variables = enforced();
    variables.enclave = "/arm";
    const auto chosen = choose_security("/nobody", variables);
    ASSERT_TRUE(chosen.ok()) << chosen.error().detail;
    EXPECT_EQ(chosen.value()->certificate, (keystore_ / "enclaves/arm/cert.pem").string());
}

TEST_F(ConfigSecurity, AMissingEnclaveIsAnErrorOnlyWhereSecurityIsEnforced) {
    EXPECT_THAT(error_of("/nobody", enforced()), HasSubstr("enclaves/nobody"));
    const auto permissive = choose_security("/nobody", {"true", {}, keystore_.string(), {}});
    ASSERT_TRUE(permissive.ok()) << permissive.error().detail;
    EXPECT_FALSE(permissive.value().has_value());
}

// A link to itself cannot be looked at, by root either: an error that names it, never "no
// security".
TEST_F(ConfigSecurity, WhatCannotBeLookedAtIsAnError) {
    fs::create_directory_symlink("loop", keystore_ / "enclaves/loop");
    const SecurityVariables permissive{"true", "Permissive", keystore_.string(), {}};
    EXPECT_THAT(error_of("/loop", permissive), HasSubstr("enclaves/loop: "));
    EXPECT_THAT(error_of("/loop", enforced()), HasSubstr("enclaves/loop: "));
    const std::string loop = (keystore_ / "enclaves/loop").string();
    EXPECT_THAT(error_of("/arm", {"true", "Permissive", loop, {}}), HasSubstr("enclaves/loop: "));
}

TEST_F(ConfigSecurity, EachMissingFileIsNamed) {
    for (const char* file : kFiles) {
        const fs::path path = keystore_ / "enclaves/arm" / file;
        fs::remove(path);
        EXPECT_THAT(error_of("/arm", enforced()),
                    AllOf(HasSubstr("enclaves/arm"), HasSubstr(file)));
        EXPECT_NE(error_of("/arm", {"true", {}, keystore_.string(), {}}), "none") << file;
        std::ofstream(path) << "x";
    }
    EXPECT_EQ(error_of("/arm", enforced()), "none");
}

TEST_F(ConfigSecurity, WrongValuesAreNamed) {
    EXPECT_THAT(error_of("/arm", {"1", "Enforce", keystore_.string(), {}}),
                HasSubstr("ROS_SECURITY_ENABLE = 1"));
    EXPECT_THAT(error_of("/arm", {"true", "enforce", keystore_.string(), {}}),
                HasSubstr("ROS_SECURITY_STRATEGY = enforce"));
    EXPECT_THAT(error_of("/arm", {"true", "Enforce", {}, {}}),
                HasSubstr("ROS_SECURITY_KEYSTORE = (unset)"));
    EXPECT_THAT(error_of("/arm", {"true", "Enforce", "/nowhere", {}}),
                HasSubstr("ROS_SECURITY_KEYSTORE = /nowhere"));
    EXPECT_THAT(error_of("/arm", {"true", "Enforce", keystore_.string(), "../arm"}),
                HasSubstr("../arm"));
}

}  // namespace
}  // namespace graspd
