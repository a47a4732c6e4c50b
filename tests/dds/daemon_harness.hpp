#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "graspd/config/load_config.hpp"
#include "graspd/dds/dds_settings.hpp"
#include "graspd/planner/plan_types.hpp"
#include "support/child_process.hpp"
#include "support/shapes.hpp"

namespace graspd::test {

/// A domain of its own for each test of the daemon; `index` below 18. 215 to 232 are the domains
/// whose ports lie above Linux's ephemeral ones, so that no other socket is in the way, and
/// test_domain() stays below them. Shifted by the checkout's path: two checkouts rarely meet.
inline std::uint32_t daemon_domain(std::uint32_t index) {
    return static_cast<std::uint32_t>(215 + (index + fnv1a(GRASPD_SOURCE_DIR)) % 18);
}

inline DdsSettings client_settings(std::uint32_t domain) {
    DdsSettings settings;
    settings.domain = domain;
    settings.profile_file = GRASPD_SOURCE_DIR "/profiles/dds/loopback.xml";
    return settings;
}

/// graspd itself in a process of its own, ready for requests.
class Daemon : public ChildProcess {
public:
    explicit Daemon(std::uint32_t domain, const std::vector<std::string>& more = {})
        : ChildProcess(GRASPD_PROGRAM, arguments(domain, more)) {
        EXPECT_TRUE(wait_for_error_text("event=ready domain=" + std::to_string(domain)))
            << errors();
    }

private:
    static std::vector<std::string> arguments(std::uint32_t domain,
                                              const std::vector<std::string>& more) {
        std::vector<std::string> all = {"--domain", std::to_string(domain), "--log-level", "debug"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

/// A file that goes with its test.
class TemporaryFile {
public:
    TemporaryFile(const std::string& name, const std::string& text);
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

/// A box of 40 x 60 x 80 mm, which parallel_85 can take across any of its sides.
PlanRequest box_request(const std::string& id);

/// A torus of so many faces that planning it takes a second or more.
PlanRequest long_request(const std::string& id);

/// A mesh as the text of an OFF file.
std::string off_text(const TriangleMesh& mesh);

}  // namespace graspd::test
