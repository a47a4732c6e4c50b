#pragma once

#include <gtest/gtest.h>

#include <string>

#include "graspd/config/load_config.hpp"
#include "graspd/dds/dds_settings.hpp"

namespace graspd::test {

/// A DDS domain for the running test: 1..200, from the test's name and the source tree, so that
/// tests of two checkouts on one machine rarely meet.
inline std::uint32_t test_domain() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const std::string name =
        std::string(GRASPD_SOURCE_DIR) + info->test_suite_name() + info->name();
    return static_cast<std::uint32_t>(1 + fnv1a(name) % 200);
}

/// Loopback only, in test_domain().
inline DdsSettings loopback_settings() {
    DdsSettings settings;
    settings.domain = test_domain();
    settings.profile_file = GRASPD_SOURCE_DIR "/profiles/dds/loopback.xml";
    settings.planner_id = "test planner";
    settings.version = "1.2.3";
    settings.config_hash = "0123456789abcdef";
    return settings;
}

}  // namespace graspd::test
