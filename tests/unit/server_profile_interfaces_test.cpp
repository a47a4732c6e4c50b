#include "profile_interfaces.hpp"

#include <gtest/gtest.h>

namespace graspd::server {
namespace {

TEST(ProfileInterfaces, AreTheEntriesOfTheWhiteLists) {
    EXPECT_EQ(profile_interfaces("<a><interfaceWhiteList><address>127.0.0.1</address>"
                                 "<interface>eth0</interface></interfaceWhiteList></a>"
                                 "<interfaceWhiteList><address>10.0.0.2</address>"
                                 "</interfaceWhiteList>"),
              "127.0.0.1,eth0,10.0.0.2");
}

TEST(ProfileInterfaces, AnAddressElsewhereOrInACommentIsNone) {
    EXPECT_EQ(profile_interfaces("<locator><address>239.255.0.1</address></locator>"), "all");
    EXPECT_EQ(profile_interfaces("<!-- <interfaceWhiteList><address>127.0.0.1</address>"
                                 "</interfaceWhiteList> -->"),
              "all");
    EXPECT_EQ(profile_interfaces("<interfaceWhiteList><address>127.0.0.1"), "all");
}

TEST(ProfileInterfaces, TheShippedDefaultIsLoopbackAlone) {
    EXPECT_EQ(profile_file_interfaces(GRASPD_SOURCE_DIR "/profiles/dds/loopback.xml"), "127.0.0.1");
    EXPECT_EQ(profile_file_interfaces("/nowhere.xml"), "unknown");
}

}  // namespace
}  // namespace graspd::server
