#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <set>

#include "graspd/config/load_config.hpp"
#include "graspd/planner/planner_config.hpp"

// profiles/planner.yaml is what people read to learn the parameters: it must hold every key, no
// other, and the values that are in force without it.

namespace graspd {
namespace {

const std::filesystem::path kFile = GRASPD_SOURCE_DIR "/profiles/planner.yaml";

void collect_keys(const YAML::Node& node, const std::string& prefix, std::set<std::string>& keys) {
    for (const auto& entry : node) {
        const std::string path = prefix + entry.first.Scalar();
        if (entry.second.IsMap()) {
            collect_keys(entry.second, path + ".", keys);
        } else {
            keys.insert(path);
        }
    }
}

TEST(PlannerYaml, HoldsExactlyTheKeysOfThePlanner) {
    std::set<std::string> expected;
    PlannerConfig config;
    for (const auto& setting : config_detail::collect(config)) {
        std::string path;
        for (const auto& name : setting.path) path += (path.empty() ? "" : ".") + name;
        expected.insert(path);
    }
    std::set<std::string> found;
    YAML::Node root = YAML::LoadFile(kFile.string());
    root.remove("server");  // the daemon's, which has a test of its own
    root.remove("share");   // likewise
    root.remove("ros");
    root.remove("supervisor");
    collect_keys(root, "", found);
    EXPECT_EQ(found, expected);
}

TEST(PlannerYaml, HoldsTheDefaultsAndEveryOneIsInItsRange) {
    const auto loaded =
        load_config<PlannerConfig>(kFile, {}, {"server", "share", "ros", "supervisor"});
    ASSERT_TRUE(loaded.ok()) << loaded.error().detail;
    EXPECT_EQ(print_config(loaded.value()), print_config(PlannerConfig{}));
}

}  // namespace
}  // namespace graspd
