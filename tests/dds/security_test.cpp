#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>

#include "daemon_harness.hpp"
#include "support/dds_domain.hpp"

// Who may speak to the planner, with a keystore that scripts/keystore makes.

namespace graspd {
namespace {

using test::ChildProcess;
using test::TemporaryFile;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

/// A keystore of this program's own, made once.
class Keystore {
public:
    explicit Keystore(const std::string& name)
        : folder_(fs::temp_directory_path() /
                  ("graspd_keystore_" + name + std::to_string(::getpid()))) {
        ChildProcess script(GRASPD_SOURCE_DIR "/scripts/keystore", {folder_.string()});
        EXPECT_EQ(script.wait_exit(), 0) << script.errors();
    }
    ~Keystore() { fs::remove_all(folder_); }
    Keystore(const Keystore&) = delete;
    Keystore& operator=(const Keystore&) = delete;

    /// A command that runs a program as one of the keystore's identities.
    std::vector<std::string> as(const std::string& enclave, const std::string& program,
                                const std::vector<std::string>& arguments) const {
        std::vector<std::string> command = {"ROS_SECURITY_ENABLE=true",
                                            "ROS_SECURITY_STRATEGY=Enforce",
                                            "ROS_SECURITY_KEYSTORE=" + folder_.string(),
                                            "ROS_SECURITY_ENCLAVE_OVERRIDE=" + enclave, program};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return command;
    }
    const fs::path& folder() const { return folder_; }

private:
    fs::path folder_;
};

constexpr const char* kEnv = "/usr/bin/env";

class Security : public testing::Test {
protected:
    static void SetUpTestSuite() { keystore_ = std::make_unique<Keystore>("ours"); }
    static void TearDownTestSuite() { keystore_.reset(); }

    std::vector<std::string> daemon_arguments() const { return {"--domain", domain_}; }
    std::vector<std::string> request_arguments(const std::string& timeout_ms) const {
        return {"request",  box_.path(), "--domain", domain_,    "--timeout",
                timeout_ms, "--retries", "1",        "--format", "json"};
    }
    bool wait_ready(ChildProcess& daemon) const {
        return daemon.wait_for_error_text("event=ready domain=" + domain_);
    }
    /// Stops the planner. @return what it logged
    static std::string log_of(ChildProcess& daemon) {
        daemon.send_signal(SIGTERM);
        EXPECT_EQ(daemon.wait_exit(), 0) << daemon.errors();
        return daemon.errors();
    }

    static inline std::unique_ptr<Keystore> keystore_;
    const std::string domain_ = std::to_string(test::test_domain());
    const TemporaryFile box_{"secure_box.off", test::off_text(test::box({0.04, 0.06, 0.08}))};
};

TEST_F(Security, AClientOfTheKeystoreIsAnswered) {
    ChildProcess daemon(kEnv, keystore_->as("/graspd", GRASPD_PROGRAM, daemon_arguments()));
    ASSERT_TRUE(wait_ready(daemon)) << daemon.errors();
    EXPECT_THAT(daemon.errors(), HasSubstr("/enclaves/graspd/cert.pem"));
    ChildProcess client(kEnv,
                        keystore_->as("/client", GRASPCTL_PROGRAM, request_arguments("8000")));
    EXPECT_EQ(client.wait_exit(), 0) << client.errors();
    EXPECT_THAT(client.output(), HasSubstr("\"status\": \"OK\""));
    ChildProcess viewer(
        kEnv, keystore_->as("/viewer", GRASPCTL_PROGRAM, {"status", "--domain", domain_}));
    EXPECT_EQ(viewer.wait_exit(), 0) << viewer.errors();
    EXPECT_THAT(log_of(daemon), HasSubstr("received=1 ok=1"));
}

// Each of them is alone with the planner, and the planner must not hear of it.
TEST_F(Security, NobodyElseReachesThePlanner) {
    const Keystore stranger("stranger");
    ChildProcess daemon(kEnv, keystore_->as("/graspd", GRASPD_PROGRAM, daemon_arguments()));
    ASSERT_TRUE(wait_ready(daemon)) << daemon.errors();
    const auto request = request_arguments("1500");

    ChildProcess plain(GRASPCTL_PROGRAM, request);
    EXPECT_EQ(plain.wait_exit(), 4) << plain.errors();
    ChildProcess other(kEnv, stranger.as("/client", GRASPCTL_PROGRAM, request));
    EXPECT_EQ(other.wait_exit(), 4) << other.errors();
    // May read, but not ask.
    ChildProcess viewer(kEnv, keystore_->as("/viewer", GRASPCTL_PROGRAM, request));
    const auto code = viewer.wait_exit();
    EXPECT_TRUE(code == 1 || code == 4) << code.value_or(-1) << viewer.errors();
    EXPECT_THAT(viewer.output(), Not(HasSubstr("grasps")));
    ChildProcess looker(GRASPCTL_PROGRAM, {"status", "--domain", domain_, "--timeout", "1500"});
    EXPECT_EQ(looker.wait_exit(), 4) << looker.output();

    EXPECT_THAT(log_of(daemon), HasSubstr("received=0 ok=0"));
}

// They see each other's status, so the keystore lets them read it. How often a request is answered
// is not asked here: under load a handshake of DDS Security may take longer than the request.
TEST_F(Security, PlannersOfTheKeystoreShareRequests) {
    auto arguments = daemon_arguments();
    arguments.insert(arguments.end(), {"--ros-args", "-p", "share.enabled:=true"});
    ChildProcess first(kEnv, keystore_->as("/graspd", GRASPD_PROGRAM, arguments));
    ChildProcess second(kEnv, keystore_->as("/graspd", GRASPD_PROGRAM, arguments));
    ASSERT_TRUE(first.wait_for_error_text("serves=true")) << first.errors();
    ASSERT_TRUE(second.wait_for_error_text("serves=true")) << second.errors();
    ASSERT_TRUE(first.wait_for_error_text("event=takes_part")) << first.errors();
    ASSERT_TRUE(second.wait_for_error_text("event=takes_part")) << second.errors();
    ChildProcess client(kEnv,
                        keystore_->as("/client", GRASPCTL_PROGRAM, request_arguments("8000")));
    EXPECT_EQ(client.wait_exit(), 0) << client.errors();
    EXPECT_THAT(log_of(first) + log_of(second), HasSubstr("received=1 ok=1"));
}

TEST_F(Security, ABrokenKeystoreEndsTheStart) {
    ChildProcess nowhere(kEnv, keystore_->as("/nobody", GRASPD_PROGRAM, daemon_arguments()));
    EXPECT_EQ(nowhere.wait_exit(), 2);
    EXPECT_THAT(nowhere.errors(), HasSubstr("/enclaves/nobody has no readable"));

    // Another identity's key: the middleware refuses it.
    const Keystore mixed("mixed");
    fs::copy_file(mixed.folder() / "enclaves/client/key.pem",
                  mixed.folder() / "enclaves/graspd/key.pem", fs::copy_options::overwrite_existing);
    ChildProcess daemon(kEnv, mixed.as("/graspd", GRASPD_PROGRAM, daemon_arguments()));
    const auto code = daemon.wait_exit();
    ASSERT_TRUE(code.has_value()) << daemon.errors();
    EXPECT_NE(*code, 0) << daemon.errors();
    EXPECT_THAT(daemon.errors(), HasSubstr("/enclaves/graspd/cert.pem valid?"));
}

}  // namespace
}  // namespace graspd
