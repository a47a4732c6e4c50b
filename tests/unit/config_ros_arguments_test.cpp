#include "graspd/config/ros_arguments.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "graspd/config/wire_names.hpp"

namespace graspd {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using Words = std::vector<std::string>;

/// What the words of one section say.
RosArguments ros(Words words) {
    words.insert(words.begin(), "--ros-args");
    auto taken = take_ros_arguments(words);
    EXPECT_TRUE(taken.ok()) << taken.error().detail;
    EXPECT_THAT(words, IsEmpty());
    return taken.ok() ? std::move(taken).value() : RosArguments{};
}

std::string refusal_of(Words words) {
    words.insert(words.begin(), {"--workers", "--ros-args"});
    const Words before = words;
    const auto taken = take_ros_arguments(words);
    EXPECT_FALSE(taken.ok());
    if (taken.ok()) return "";
    EXPECT_EQ(words, before);
    EXPECT_EQ(taken.error().code, PlanErrorCode::kInvalidInput);
    return taken.error().detail;
}

std::string topic(const RosArguments& arguments, const std::string& name) {
    return resolve_name(arguments, name, RosNameKind::kTopic).value();
}

std::string service(const RosArguments& arguments, const std::string& name) {
    return resolve_name(arguments, name, RosNameKind::kService).value();
}

TEST(TakeRosArguments, WithoutASectionNothingIsTaken) {
    Words words = {"--workers", "2", "--", "-r", "a:=b"};
    const auto taken = take_ros_arguments(words);
    ASSERT_TRUE(taken.ok());
    EXPECT_THAT(words, ElementsAre("--workers", "2", "--", "-r", "a:=b"));
    EXPECT_EQ(taken.value().node_name, "graspd");
    EXPECT_EQ(taken.value().node_namespace, "/");
    EXPECT_EQ(taken.value().enclave, "/");
    EXPECT_FALSE(taken.value().log_level);
    EXPECT_THAT(taken.value().rules, IsEmpty());
}

// The first -- after --ros-args ends the section and goes with it; the next is the program's.
TEST(TakeRosArguments, SectionsEndAtTwoDashesOrAtTheEnd) {
    Words words = {"--domain",     "3",          "--ros-args", "-r",
                   "__ns:=/cell1", "--",         "--",         "x",
                   "--ros-args",   "--ros-args", "-e",         "/a",
                   "--",           "-p",         "--ros-args", "--params-file",
                   "f.yaml"};
    const auto taken = take_ros_arguments(words);
    ASSERT_TRUE(taken.ok()) << taken.error().detail;
    EXPECT_THAT(words, ElementsAre("--domain", "3", "--", "x", "-p"));
    EXPECT_EQ(taken.value().node_namespace, "/cell1");
    EXPECT_EQ(taken.value().enclave, "/a");
    EXPECT_THAT(taken.value().params_files, ElementsAre("f.yaml"));
}

TEST(TakeRosArguments, LongAndShortOptionsAndThoseThatAreIgnored) {
    const auto got = ros({"--remap", "__node:=a", "--param", "b:=1", "--enclave", "/c", "-e", "/d",
                          "--log-config-file", "f", "--log-file-name", "g", "--enable-rosout-logs",
                          "--disable-rosout-logs", "--enable-stdout-logs", "--disable-stdout-logs",
                          "--enable-external-lib-logs", "--disable-external-lib-logs"});
    EXPECT_EQ(got.node_name, "a");
    EXPECT_THAT(got.parameters, ElementsAre(Pair("b", "1")));
    EXPECT_EQ(got.enclave, "/d");
}

TEST(TakeRosArguments, AWrongWordOrValueIsNamedAndNothingIsTaken) {
    EXPECT_THAT(refusal_of({"--workers", "2"}), HasSubstr("unknown argument --workers"));
    EXPECT_THAT(refusal_of({"a:=b"}), HasSubstr("unknown argument a:=b"));
    EXPECT_THAT(refusal_of({"-r", "a:=b", "-p"}), HasSubstr("no value after -p"));
    EXPECT_THAT(refusal_of({"-r", "--"}), HasSubstr("remapping rule = --"));
    EXPECT_THAT(refusal_of({"-r", "a*:=b"}), HasSubstr("remapping rule = a*:=b"));
    EXPECT_THAT(refusal_of({"-e", "a"}), HasSubstr("--enclave = a must start with '/'"));
    EXPECT_THAT(refusal_of({"--log-level", "loud"}), HasSubstr("--log-level loud"));
    EXPECT_THAT(refusal_of({"--log-level", "warning"}), HasSubstr("debug, info, warn, error"));
    EXPECT_THAT(refusal_of({"--log-level", ":=info"}), HasSubstr("--log-level :=info"));
    EXPECT_THAT(refusal_of({"--log-level", "other:=loud"}), HasSubstr("--log-level other:=loud"));
    for (const char* bad : {":=", ":=bar", "1", "1:=2", "~:=1", "__ns:=foo", ":__node:=x", "a.:=1",
                            ".a:=1", "a..b:=1", "a.7:=1", "a/7:=1", "}foo:=1", "f oo:=1", "*:=1"}) {
        EXPECT_THAT(refusal_of({"-p", bad}), AllOf(HasSubstr(bad), HasSubstr("NAME:=VALUE")));
    }
    for (const char* bad : {"a:=", "a:=~", "a:=[1, 2]", "a:={b: 1}", "a:=[1", "a:=# 1"}) {
        EXPECT_THAT(refusal_of({"-p", bad}), AllOf(HasSubstr(bad), HasSubstr("one YAML scalar")));
    }
}

TEST(TakeRosArguments, ParametersKeepTheirOrderAndTheirYaml) {
    const auto got =
        ros({"-p", "server.workers:=4", "-p", "server.workers:=2", "-p", "a_1/b:=\"4\"", "-p",
             "c:=x:=y", "-p", "d:='it''s'", "-p", "e:= 1.5  # m"});
    EXPECT_THAT(got.parameters,
                ElementsAre(Pair("server.workers", "4"), Pair("server.workers", "2"),
                            Pair("a_1/b", "\"4\""), Pair("c", "x:=y"), Pair("d", "\"it's\""),
                            Pair("e", "1.5")));
}

TEST(TakeRosArguments, AParameterForAnotherNodeIsLeftOut) {
    const auto got = ros({"-p", "planner:a:=1", "-p", "graspd:b:=2", "-p", "other:c:=[1]", "-r",
                          "__node:=planner", "-r", "__ns:=/cell1"});
    EXPECT_THAT(got.parameters, ElementsAre(Pair("a", "1")));
}

TEST(TakeRosArguments, LogLevelsBecomeTheDaemonsInAnyCase) {
    const std::pair<const char*, const char*> cases[] = {
        {"debug", "debug"}, {"INFO", "info"},   {"Warn", "warning"},
        {"error", "error"}, {"FATAL", "error"},
    };
    for (const auto& [said, level] : cases) EXPECT_EQ(ros({"--log-level", said}).log_level, level);
    EXPECT_EQ(ros({"--log-level", "info", "--log-level", "error"}).log_level, "error");
}

TEST(TakeRosArguments, ALevelForThisLoggerGoesBeforeOneForAll) {
    const auto level = [](Words words) { return ros(std::move(words)).log_level; };
    EXPECT_EQ(level({"--log-level", "graspd:=debug", "--log-level", "error"}), "debug");
    EXPECT_EQ(level({"--log-level", "rcl:=debug", "--log-level", "error"}), "error");
    EXPECT_FALSE(level({"--log-level", "grasp:=debug"}));
    EXPECT_EQ(
        level({"-r", "__ns:=/a/b", "--log-level", "a.b.graspd:=warn", "--log-level", "a:=debug"}),
        "warning");
    EXPECT_EQ(level({"-r", "__ns:=/a/b", "--log-level", "a:=debug"}), "debug");
    EXPECT_FALSE(level({"-r", "__ns:=/a/b", "--log-level", "graspd:=debug"}));
}

TEST(WireNames, FollowNamespaceAndRules) {
    EXPECT_EQ(wire_names({}).value().markers, WireNames{}.markers);
    const auto names = wire_names(ros({"-r", "__ns:=/cell1", "-r", "graspd/markers:=/pictures"}));
    ASSERT_TRUE(names.ok());
    EXPECT_EQ(names.value().markers, "rt/pictures");
    EXPECT_EQ(names.value().status, "rt/cell1/graspd/status");
}

TEST(ResolveName, NodeAndNamespaceStandInFullNames) {
    const auto got = ros({"-r", "__ns:=/cell1", "-r", "__node:=planner"});
    EXPECT_EQ(topic(got, "graspd/grasp_request"), "/cell1/graspd/grasp_request");
    EXPECT_EQ(topic(got, "~/x"), "/cell1/planner/x");
    EXPECT_EQ(topic(got, "/diagnostics"), "/diagnostics");
    EXPECT_EQ(topic({}, "graspd/grasp_request"), "/graspd/grasp_request");
}

TEST(ResolveName, TheFirstRuleThatAppliesWinsAndIsAppliedOnce) {
    EXPECT_EQ(ros({"-r", "__node:=a", "-r", "__name:=b"}).node_name, "a");
    EXPECT_EQ(ros({"-r", "__ns:=/a", "-r", "__ns:=/b"}).node_namespace, "/a");
    const auto got = ros({"-r", "x:=y", "-r", "/x:=/z", "-r", "y:=w"});
    EXPECT_EQ(topic(got, "x"), "/y");
    EXPECT_EQ(topic(got, "y"), "/w");
    EXPECT_EQ(topic(got, "x/x"), "/x/x");
}

// Both sides of a rule are expanded like a name of the node.
TEST(ResolveName, RulesSpeakOfNamesInTheNodesNamespace) {
    const auto got =
        ros({"-r", "status:=state", "-r", "~/x:=/abs", "-r", "/abs2:=~/y", "-r", "__ns:=/cell1"});
    EXPECT_EQ(topic(got, "status"), "/cell1/state");
    EXPECT_EQ(topic(got, "/status"), "/status");
    EXPECT_EQ(topic(got, "/cell1/status"), "/cell1/state");
    EXPECT_EQ(topic(got, "~/x"), "/abs");
    EXPECT_EQ(topic(got, "/abs2"), "/cell1/graspd/y");
}

TEST(ResolveName, ASchemeLimitsARuleToTopicsOrServices) {
    const auto got = ros({"-r", "rostopic://a:=t", "-r", "rosservice://a:=s", "-r", "b:=c"});
    EXPECT_EQ(topic(got, "a"), "/t");
    EXPECT_EQ(service(got, "a"), "/s");
    EXPECT_EQ(topic(got, "b"), "/c");
    EXPECT_EQ(service(got, "b"), "/c");
}

// The design article's example: talker:__ns:=/my_namespace, then talker:__node:=foo leaves "/",
// because the node is renamed first. rcl_node_init does the same.
TEST(ResolveName, ARuleForANodeAsksForItsNameOfThatMoment) {
    const auto article = ros({"-r", "graspd:__ns:=/my_namespace", "-r", "graspd:__node:=foo"});
    EXPECT_EQ(article.node_name, "foo");
    EXPECT_EQ(article.node_namespace, "/");
    const auto got = ros({"-r", "other:__node:=no", "-r", "__node:=planner", "-r",
                          "planner:__ns:=/cell1", "-r", "graspd:a:=b", "-r", "planner:a:=c"});
    EXPECT_EQ(got.node_name, "planner");
    EXPECT_EQ(topic(got, "a"), "/cell1/c");
}

TEST(ResolveName, AResultThatIsNoNameIsAnError) {
    EXPECT_FALSE(resolve_name({}, "a//b", RosNameKind::kTopic).ok());
    const auto got =
        ros({"-r", "__ns:=/" + std::string(200, 'n'), "-r", "a:=" + std::string(100, 't')});
    const auto name = resolve_name(got, "a", RosNameKind::kTopic);
    ASSERT_FALSE(name.ok());
    EXPECT_EQ(name.error().code, PlanErrorCode::kInvalidInput);
    EXPECT_THAT(name.error().detail, HasSubstr("at most 247 characters"));
}

class ReadParamsFile : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(file_); }
    Result<RosParameters> read(const std::string& text, const RosArguments& node = {}) const {
        std::ofstream(file_) << text;
        return read_params_file(file_, node);
    }
    const std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) / ("params_" + std::to_string(getpid()));
};

TEST_F(ReadParamsFile, GroupsAreJoinedByDotsAndOtherNodesLeftOut) {
    const auto got = read(R"(---
/**:
  ros__parameters:
    server: {workers: 4, deep: {x: 0.5}}
    name: "42"
other:
  ros__parameters: {list: [1, 2], empty: }
graspd:
  ros__parameters:
    server.workers: 2
    ros__parameters: {y: yes}
)");
    ASSERT_TRUE(got.ok()) << got.error().detail;
    EXPECT_THAT(got.value(), ElementsAre(Pair("server.workers", "4"), Pair("server.deep.x", "0.5"),
                                         Pair("name", "\"42\""), Pair("server.workers", "2"),
                                         Pair("ros__parameters.y", "yes")));
}

TEST_F(ReadParamsFile, KeysNameTheNodeInItsNamespace) {
    const auto node = ros({"-r", "__ns:=/cell1"});
    const auto got = read(R"(
graspd: {ros__parameters: {a: 1}}
cell1: {graspd: {ros__parameters: {b: 1}}}
/cell1/graspd: {ros__parameters: {c: 1}}
/cell1/*: {ros__parameters: {d: 1}}
/cell2/*: {ros__parameters: {e: 1}}
/**: {graspd: {ros__parameters: {f: 1}}}
/: {cell1: {graspd: {ros__parameters: {g: 1}}}}
)",
                          node);
    ASSERT_TRUE(got.ok()) << got.error().detail;
    EXPECT_THAT(got.value(), ElementsAre(Pair("b", "1"), Pair("c", "1"), Pair("d", "1"),
                                         Pair("f", "1"), Pair("g", "1")));
}

TEST_F(ReadParamsFile, AnythingElseIsAnErrorThatNamesTheKey) {
    const std::pair<const char*, const char*> cases[] = {
        {"graspd:\n  ros__parameters:\n    a: {b: [1]}", ":3: a.b = (a list) must be one value"},
        {"graspd:\n  ros__parameters:\n    a:\n", "a = (nothing) must be one value"},
        {"graspd: {ros__parameters: {a: 1, a: 2}}", ":1: a is given twice"},
        {"graspd: {ros__parameters: [1]}", "ros__parameters = (a list)"},
        {"graspd: {a: 1}", "graspd/a = 1 must be a group"},
        {"ros__parameters: {a: 1}", "ros__parameters = (a group of keys) must stand below a node"},
        {"/foo: {/*: {ros__parameters: {a: 1}}}", "node = /foo//* must not be empty"},
        {"/gr*: {ros__parameters: {a: 1}}", "node = /gr*"},
        {"[1]", "the file = (a list)"},
        // An alias for a group that holds it once used up the stack.
        {"&a {b: *a}", "is nested deeper than 32 groups"},
        {"graspd: {ros__parameters: &a {b: *a}}", "is nested deeper than 32 groups"},
    };
    for (const auto& [text, detail] : cases) {
        const auto got = read(text);
        ASSERT_FALSE(got.ok()) << text;
        EXPECT_EQ(got.error().code, PlanErrorCode::kInvalidInput);
        EXPECT_THAT(got.error().detail, AllOf(HasSubstr(file_.string()), HasSubstr(detail)));
    }
    EXPECT_EQ(read("a: [").error().code, PlanErrorCode::kUnreadableFile);
    EXPECT_EQ(read_params_file("/nowhere.yaml", {}).error().code, PlanErrorCode::kUnreadableFile);
    EXPECT_THAT(read("").value(), IsEmpty());
}

// Groups that double at every level: 30 lines for 2^30 groups.
TEST_F(ReadParamsFile, DoublingAliasesEnd) {
    std::string text = "n0: &n0 {ros__parameters: {x: 1}}\n";
    for (int i = 1; i < 30; ++i) {
        const std::string last = "*n" + std::to_string(i - 1), name = "n" + std::to_string(i);
        text += name + ": &" + name + " {a: " + last + ", b: " + last + "}\n";
    }
    const auto got = read(text);
    ASSERT_FALSE(got.ok());
    EXPECT_THAT(got.error().detail, HasSubstr("is one group more than 100000"));
}

}  // namespace
}  // namespace graspd
