#include "server_config.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "graspd/config/load_config.hpp"

namespace graspd::server {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path kFile = GRASPD_SOURCE_DIR "/profiles/planner.yaml";

TEST(DaemonConfig, PlannerYamlHoldsEveryDefault) {
    const auto loaded = load_config<DaemonConfig>(kFile);
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    EXPECT_EQ(print_config(loaded.value()), print_config(DaemonConfig{}));
    std::ifstream stream(kFile);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    ServerConfig config;
    ShareConfig share;
    RosConfig ros;
    SupervisorConfig supervisor;
    for (const auto& settings : {config_detail::collect(config), config_detail::collect(share),
                                 config_detail::collect(ros), config_detail::collect(supervisor)}) {
        for (const auto& setting : settings) {
            EXPECT_THAT(text, HasSubstr("\n  " + setting.path.back() + ": "));
        }
    }
}

TEST(DaemonConfig, ABadValueIsNamedWithItsKeyAndRange) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("server_" + std::to_string(getpid()));
    const auto error_of = [&](const std::string& text) {
        std::ofstream(file) << text;
        const auto loaded = load_config<DaemonConfig>(file);
        return loaded.ok() ? std::string("none") : loaded.error().detail;
    };
    EXPECT_THAT(error_of("server:\n  workers: 0\n"),
                HasSubstr("server.workers = 0 is outside [1, 256]"));
    EXPECT_THAT(error_of("server:\n  workers: many\n"),
                AllOf(HasSubstr("server.workers"), HasSubstr("many"), HasSubstr("[1, 256]")));
    EXPECT_THAT(error_of("server:\n  threads: 3\n"), HasSubstr("server.threads"));
    EXPECT_EQ(error_of("server:\n  object_cache_bytes: 0\n"), "none");
    EXPECT_THAT(error_of("server:\n  markers: sometimes\n"),
                AllOf(HasSubstr("server.markers"), HasSubstr("sometimes"),
                      HasSubstr("never, on_request, always")));
    EXPECT_THAT(error_of("server:\n  markers_max_faces: 4000000\n"),
                HasSubstr("server.markers_max_faces = 4000000 is outside [100, 200000]"));
    std::filesystem::remove(file);
}

TEST(DaemonConfig, MarkersAreServedOnRequestUnlessTold) {
    ServerConfig config;
    EXPECT_EQ(config.markers_when(), MarkersWhen::kOnRequest);
    config.markers = "never";
    EXPECT_EQ(config.markers_when(), MarkersWhen::kNever);
    config.markers = "always";
    EXPECT_EQ(config.markers_when(), MarkersWhen::kAlways);
}

}  // namespace
}  // namespace graspd::server
