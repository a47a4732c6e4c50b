#include "graspd/config/ros_names.hpp"

#include <gmock/gmock.h>

namespace graspd {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using What = RemapRule::What;

TEST(RosNames, DdsTopicsCarryRos2sPrefixesAndEndings) {
    EXPECT_EQ(dds_topic_name("/graspd/status", DdsTopicKind::kTopic), "rt/graspd/status");
    EXPECT_EQ(dds_topic_name("/graspd/plan_grasps", DdsTopicKind::kServiceRequest),
              "rq/graspd/plan_graspsRequest");
    EXPECT_EQ(dds_topic_name("/graspd/plan_grasps", DdsTopicKind::kServiceReply),
              "rr/graspd/plan_graspsReply");
}

TEST(RosNames, RelativePrivateAndAbsoluteNamesExpand) {
    EXPECT_EQ(expand_name("graspd/status", "/", "graspd").value(), "/graspd/status");
    EXPECT_EQ(expand_name("graspd/status", "/cell1/a", "graspd").value(), "/cell1/a/graspd/status");
    EXPECT_EQ(expand_name("~/x", "/", "planner").value(), "/planner/x");
    EXPECT_EQ(expand_name("~/x", "/cell1", "planner").value(), "/cell1/planner/x");
    EXPECT_EQ(expand_name("~", "/cell1", "planner").value(), "/cell1/planner");
    EXPECT_EQ(expand_name("/diagnostics", "/cell1", "planner").value(), "/diagnostics");
    EXPECT_EQ(expand_name("a__b", "/", "n").value(), "/a__b");  // rmw lets it pass
}

TEST(RosNames, ANameThatRos2RefusesIsNamedWithTheReason) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "must not be empty"},      {"7a", "starts with a digit"},
        {"a/7", "starts with a digit"}, {"a//b", "must not hold '//'"},
        {"a/", "must not end"},         {"/", "must not end"},
        {"~a", "'/' after '~'"},        {"a~", "letters, digits"},
        {"a-b", "letters, digits"},     {"a b", "letters, digits"},
        {"{node}", "letters, digits"},  {"\xC3\xA9", "letters"},
    };
    for (const auto& [name, reason] : cases) {
        const auto full = expand_name(name, "/", "graspd");
        ASSERT_FALSE(full.ok()) << name;
        EXPECT_EQ(full.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_THAT(full.error().detail,
                    AllOf(HasSubstr("ROS name = "), HasSubstr(name), HasSubstr(reason)));
    }
}

// rmw: 247 = 255 less 8 reserved for prefixes; a namespace leaves room for "/x"; names of nodes
// 255.
TEST(RosNames, LengthsEndWhereRmwEndsThem) {
    EXPECT_TRUE(expand_name("/" + std::string(246, 'a'), "/", "n").ok());
    EXPECT_FALSE(expand_name("/" + std::string(247, 'a'), "/", "n").ok());
    EXPECT_FALSE(check_namespace("ns", "/" + std::string(244, 'a')));
    EXPECT_TRUE(check_namespace("ns", "/" + std::string(245, 'a')));
    EXPECT_FALSE(check_enclave("enclave", "/" + std::string(254, 'a')));
    EXPECT_TRUE(check_enclave("enclave", "/" + std::string(255, 'a')));
    EXPECT_FALSE(check_node_name("node", std::string(255, 'a')));
    EXPECT_TRUE(check_node_name("node", std::string(256, 'a')));
}

TEST(RosNames, NodesAndNamespacesAreCheckedAsRmwDoes) {
    for (const char* good : {"graspd", "_a", "a_1", "A__b"}) {
        EXPECT_FALSE(check_node_name("node", good)) << good;
    }
    for (const char* bad : {"", "1a", "a/b", "a.b", "/a", "a-b"}) {
        EXPECT_TRUE(check_node_name("node", bad)) << bad;
    }
    for (const char* good : {"/", "/a", "/a/b_2"})
        EXPECT_FALSE(check_namespace("ns", good)) << good;
    for (const char* bad : {"", "a", "/a/", "//", "/a//b", "/1a", "/a.b"}) {
        EXPECT_TRUE(check_namespace("ns", bad)) << bad;
    }
    EXPECT_EQ(check_namespace("--enclave", "a")->detail, "--enclave = a must start with '/'");
}

TEST(ParseRemapRule, ReadsEveryForm) {
    struct Case {
        const char* text;
        What what;
        const char* node;
        const char* from;
        const char* to;
    };
    const Case cases[] = {
        {"__node:=planner", What::kNodeName, "", "", "planner"},
        {"__name:=planner", What::kNodeName, "", "", "planner"},
        {"graspd:__node:=planner", What::kNodeName, "graspd", "", "planner"},
        {"__ns:=/cell1/left", What::kNamespace, "", "", "/cell1/left"},
        {"__ns:=/", What::kNamespace, "", "", "/"},
        {"graspd:__ns:=/a", What::kNamespace, "graspd", "", "/a"},
        {"a/b:=c", What::kTopicOrService, "", "a/b", "c"},
        {"~/a:=/b/c", What::kTopicOrService, "", "~/a", "/b/c"},
        {"/a:=~/b", What::kTopicOrService, "", "/a", "~/b"},
        {"graspd:a:=b", What::kTopicOrService, "graspd", "a", "b"},
        {"rostopic://a:=b", What::kTopic, "", "a", "b"},
        {"rosservice:///a:=b", What::kService, "", "/a", "b"},
        {"graspd:rosservice://~/a:=~/b", What::kService, "graspd", "~/a", "~/b"},
        {"rostopic:a:=b", What::kTopicOrService, "rostopic", "a", "b"},  // a node of that name
    };
    for (const Case& c : cases) {
        const auto rule = parse_remap_rule(c.text);
        ASSERT_TRUE(rule.ok()) << rule.error().detail;
        EXPECT_EQ(rule.value().what, c.what) << c.text;
        EXPECT_EQ(rule.value().node, c.node) << c.text;
        EXPECT_EQ(rule.value().from, c.from) << c.text;
        EXPECT_EQ(rule.value().to, c.to) << c.text;
    }
}

// What rcl's own tests refuse, and its lexer: no wildcards, no "__" within a token.
TEST(ParseRemapRule, ABrokenRuleIsNamed) {
    for (const char* bad : {"",
                            ":",
                            "1",
                            "~",
                            ":=",
                            "foo:=",
                            ":=bar",
                            "::=",
                            "1:=",
                            "~:=",
                            "__node:=",
                            "__node:=/foo/bar",
                            "__ns:=",
                            "__ns:=foo",
                            "__ns:=/foo/",
                            "__ns:=//",
                            ":__node:=nodename",
                            "~:__node:=nodename",
                            "}foo:=/bar",
                            "f oo:=/bar",
                            "foo:=/b ar",
                            "f{oo:=/bar",
                            "foo:=/b}ar",
                            "rostopic://:=rosservice",
                            "rostopic::=rosservice",
                            "*:=a",
                            "/a/*:=b",
                            "a:=/b/\\1",
                            "a__b:=c",
                            "a:=b__c",
                            "__ns:=/a__b",
                            "__node:=a__b",
                            "rostopic://__ns:=/a",
                            "rostopic://n:a:=b",
                            "a:=b:=c",
                            "a//b:=c",
                            "a:=b/",
                            "/:=a"}) {
        const auto rule = parse_remap_rule(bad);
        ASSERT_FALSE(rule.ok()) << bad;
        EXPECT_EQ(rule.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_THAT(rule.error().detail, AllOf(HasSubstr("remapping rule"), HasSubstr(bad)));
    }
}

TEST(NodeKeyMatches, StarsStandForOneTokenOrAnyNumber) {
    const auto matches = [](const char* key, const char* node) {
        return node_key_matches(key, node).value();
    };
    EXPECT_TRUE(matches("/**", "/graspd"));
    EXPECT_TRUE(matches("/**", "/a/b/graspd"));
    EXPECT_TRUE(matches("graspd", "/graspd"));
    EXPECT_FALSE(matches("graspd", "/a/graspd"));
    EXPECT_TRUE(matches("/a/graspd", "/a/graspd"));
    EXPECT_TRUE(matches("a/graspd", "/a/graspd"));
    EXPECT_TRUE(matches("/a/*", "/a/graspd"));
    EXPECT_FALSE(matches("/a/*", "/a/b/graspd"));
    EXPECT_FALSE(matches("/*", "/a/graspd"));
    EXPECT_TRUE(matches("/*/graspd", "/a/graspd"));
    EXPECT_FALSE(matches("/*/graspd", "/graspd"));
    EXPECT_TRUE(matches("/**/graspd", "/graspd"));
    EXPECT_TRUE(matches("/**/graspd", "/a/b/graspd"));
    EXPECT_TRUE(matches("/a/**/graspd", "/a/b/c/graspd"));
    EXPECT_FALSE(matches("/**/other", "/a/graspd"));
    for (const char* bad : {"/a//b", "/a*", "/*a", "", "/", "/a/", "/a/***", "/1"}) {
        const auto got = node_key_matches(bad, "/graspd");
        ASSERT_FALSE(got.ok()) << bad;
        EXPECT_THAT(got.error().detail, HasSubstr(std::string("node = ") + bad));
    }
}

}  // namespace
}  // namespace graspd
