#include "graspd/config/network_profile.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

namespace graspd {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kProfiles = "/p";
constexpr const char* kLan = "/p/dds/lan.xml";
constexpr const char* kLoopback = "/p/dds/loopback.xml";

NetworkChoice chosen(const NetworkEnvironment& environment, const std::string& option = "") {
    auto choice = choose_network(option, kProfiles, environment);
    EXPECT_TRUE(choice.ok()) << choice.error().detail;
    return choice.ok() ? std::move(choice).value() : NetworkChoice{};
}

std::string error_of(const NetworkEnvironment& environment, const std::string& option = "") {
    const auto choice = choose_network(option, kProfiles, environment);
    EXPECT_FALSE(choice.ok());
    if (choice.ok()) return "";
    EXPECT_EQ(choice.error().code, PlanErrorCode::kInvalidInput);
    return choice.error().detail;
}

TEST(ChooseNetwork, TheOptionGoesBeforeLocalhostOnlyBeforeTheRangeBeforeLoopback) {
    EXPECT_EQ(chosen({}).profile_file, kLoopback);
    EXPECT_THAT(chosen({}).why, HasSubstr("built-in"));
    EXPECT_EQ(chosen({.localhost_only = "0"}).profile_file, kLan);
    EXPECT_EQ(chosen({.localhost_only = "0"}).why, "ROS_LOCALHOST_ONLY = 0");
    EXPECT_EQ(chosen({.localhost_only = "1"}).profile_file, kLoopback);
    const NetworkEnvironment both = {.discovery_range = "SUBNET", .localhost_only = "1"};
    EXPECT_EQ(chosen(both).profile_file, kLoopback);  // whoever says "only here" means it
    EXPECT_EQ(chosen(both).why, "ROS_LOCALHOST_ONLY = 1");
    const NetworkEnvironment wide = {.discovery_range = "SUBNET", .localhost_only = "0"};
    EXPECT_EQ(chosen(wide).profile_file, kLan);
    EXPECT_EQ(chosen(wide).why,
              "ROS_AUTOMATIC_DISCOVERY_RANGE = SUBNET, before ROS_LOCALHOST_ONLY = 0");
    EXPECT_EQ(chosen({.discovery_range = "LOCALHOST", .localhost_only = "0"}).profile_file,
              kLoopback);
    EXPECT_EQ(chosen({.discovery_range = "SYSTEM_DEFAULT", .localhost_only = "0"}).profile_file,
              kLoopback);
    EXPECT_EQ(chosen(both, "my.xml").profile_file, "my.xml");
    EXPECT_EQ(chosen(both, "my.xml").why, "--profile");
}

TEST(ChooseNetwork, WhatIsNotAskedIsNotJudged) {
    EXPECT_EQ(chosen({.discovery_range = "SUBNET", .localhost_only = "x"}).profile_file, kLan);
    EXPECT_EQ(chosen({.discovery_range = "OFF", .localhost_only = "x"}, "my.xml").profile_file,
              "my.xml");
}

TEST(ChooseNetwork, AWrongValueIsNamedWithItsVariable) {
    for (const char* bad : {"subnet", "Localhost", "NOT_SET", "1"}) {
        EXPECT_THAT(error_of({.discovery_range = bad, .localhost_only = "0"}),
                    AllOf(HasSubstr(std::string("ROS_AUTOMATIC_DISCOVERY_RANGE = ") + bad),
                          HasSubstr("SUBNET, LOCALHOST, SYSTEM_DEFAULT or OFF")));
    }
    for (const char* bad : {"true", "10", "01", " 1"}) {
        EXPECT_EQ(error_of({.localhost_only = bad}),
                  std::string("ROS_LOCALHOST_ONLY = ") + bad + " must be 0 or 1");
    }
    EXPECT_THAT(error_of({.discovery_range = "OFF"}),
                AllOf(HasSubstr("= OFF lets nobody find graspd"), HasSubstr("SUBNET")));
}

TEST(ChooseNetwork, StaticPeersAreSplitAtSemicolons) {
    const auto peers = [](const char* text) {
        return chosen({.discovery_range = "SUBNET", .static_peers = text}).static_peers;
    };
    EXPECT_THAT(peers("192.168.0.1;remote.com"), ElementsAre("192.168.0.1", "remote.com"));
    EXPECT_THAT(peers(";10.0.0.7;;robot_1-a;"), ElementsAre("10.0.0.7", "robot_1-a"));
    EXPECT_THAT(peers(";"), IsEmpty());
    EXPECT_THAT(peers("0.0.0.0;255.255.255.255;1a.2b"), testing::SizeIs(3));
    EXPECT_THAT(peers((std::string(63, 'a') + ".b").c_str()), testing::SizeIs(1));
    EXPECT_THAT(chosen({}).static_peers, IsEmpty());
}

TEST(ChooseNetwork, APeerThatIsNoHostIsNamed) {
    const std::string long_name = std::string(60, 'a') + "." + std::string(60, 'b') + "." +
                                  std::string(60, 'c') + "." + std::string(60, 'd') + ".abcdefghij";
    ASSERT_EQ(long_name.size(), 254u);  // one more than a name may have
    for (const std::string& bad :
         {std::string("256.0.0.1"), std::string("1.2.3"), std::string("1.2.3.4.5"),
          std::string("1.2.3."), std::string("01.2.3.4"), std::string("1..3.4"), std::string("7"),
          std::string("a b"), std::string(" a"), std::string("a,b"), std::string("-a"),
          std::string("a-"), std::string("a..b"), std::string("a."), std::string("fe80::1"),
          std::string("host:7400"), std::string(64, 'a'), long_name}) {
        const NetworkEnvironment with = {.discovery_range = "SUBNET", .static_peers = "ok;" + bad};
        EXPECT_THAT(error_of(with), AllOf(HasSubstr("ROS_STATIC_PEERS = ok;" + bad),
                                          HasSubstr("'" + bad + "' is neither")));
        EXPECT_THAT(error_of(with, "my.xml"), HasSubstr("is neither"));
    }
    EXPECT_TRUE(choose_network("", kProfiles,
                               {.discovery_range = "SUBNET", .static_peers = long_name.substr(1)})
                    .ok());
}

// loopback.xml binds to 127.0.0.1: packets for any other address never leave.
TEST(ChooseNetwork, LoopbackReachesNoPeerButItself) {
    EXPECT_THAT(chosen({.static_peers = "127.0.0.1;localhost"}).static_peers,
                ElementsAre("127.0.0.1", "localhost"));
    for (const NetworkEnvironment& base :
         {NetworkEnvironment{}, NetworkEnvironment{.discovery_range = "LOCALHOST"}}) {
        for (const char* peer : {"10.0.0.7", "127.0.0.2", "robot"}) {
            NetworkEnvironment environment = base;
            environment.static_peers = std::string("127.0.0.1;") + peer;
            EXPECT_THAT(
                error_of(environment),
                AllOf(HasSubstr(std::string("the peer ") + peer + ","),
                      HasSubstr("ROS_AUTOMATIC_DISCOVERY_RANGE = SUBNET"), HasSubstr("--profile")));
        }
    }
    EXPECT_THAT(chosen({.localhost_only = "0", .static_peers = "10.0.0.7"}).static_peers,
                ElementsAre("10.0.0.7"));
    EXPECT_THAT(chosen({.static_peers = "10.0.0.7"}, "my.xml").static_peers,
                ElementsAre("10.0.0.7"));
}

// rmw_fastrtps adds peers for LOCALHOST and SUBNET alone.
TEST(ChooseNetwork, SystemDefaultLeavesThePeersAside) {
    const auto choice = chosen({.discovery_range = "SYSTEM_DEFAULT", .static_peers = "10.0.0.7"});
    EXPECT_THAT(choice.static_peers, IsEmpty());
    EXPECT_EQ(choice.profile_file, kLoopback);
    EXPECT_THAT(choice.why, HasSubstr("without ROS_STATIC_PEERS"));
    const auto only = chosen({.localhost_only = "1", .static_peers = "10.0.0.7"});
    EXPECT_THAT(only.static_peers, IsEmpty());
    EXPECT_EQ(only.why, "ROS_LOCALHOST_ONLY = 1, without ROS_STATIC_PEERS");
}

class NetworkVariables : public testing::Test {
protected:
    void SetUp() override { clear(); }
    void TearDown() override { clear(); }
    static void clear() {
        ::unsetenv("ROS_AUTOMATIC_DISCOVERY_RANGE");
        ::unsetenv("ROS_LOCALHOST_ONLY");
        ::unsetenv("ROS_STATIC_PEERS");
    }
};

TEST_F(NetworkVariables, AreReadEachAndAbsentWhenUnsetOrEmpty) {
    ::setenv("ROS_STATIC_PEERS", "", 1);
    EXPECT_FALSE(network_environment().discovery_range);
    EXPECT_FALSE(network_environment().localhost_only);
    EXPECT_FALSE(network_environment().static_peers);
    ::setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET", 1);
    ::setenv("ROS_LOCALHOST_ONLY", "1", 1);
    ::setenv("ROS_STATIC_PEERS", "a;b", 1);
    EXPECT_EQ(network_environment().discovery_range, "SUBNET");
    EXPECT_EQ(network_environment().localhost_only, "1");
    EXPECT_EQ(network_environment().static_peers, "a;b");
}

}  // namespace
}  // namespace graspd
