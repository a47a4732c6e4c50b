// graspd records what it receives; graspctl replay plans it again.
#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "convert_request.hpp"
#include "daemon_harness.hpp"
#include "graspd/dds/payloads.hpp"
#include "graspd/planner/planner.hpp"
#include "raw_endpoints.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::ChildProcess;
using test::Daemon;
using test::daemon_domain;
using test::payload_of;
using test::TemporaryFile;
using testing::HasSubstr;

class RecordTest : public testing::Test {
protected:
    RecordTest()
        : directory_(fs::path(testing::TempDir()) / ("record_" + std::to_string(getpid()))) {
        fs::remove_all(directory_);
    }
    ~RecordTest() override { fs::remove_all(directory_); }

    Bytes contents(const std::string& name) const {
        std::ifstream stream(directory_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    /// `graspctl replay`: its exit code and output.
    std::pair<std::optional<int>, std::string> replay(const std::string& name,
                                                      std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {"replay", (directory_ / name).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        ChildProcess child(GRASPCTL_PROGRAM, arguments);
        const auto code = child.wait_exit();
        return {code, child.output() + child.errors()};
    }

    fs::path directory_;
};

TEST_F(RecordTest, WhatIsRecordedIsPlannedAgainToTheSameReply) {
    const std::uint32_t domain = daemon_domain(16);
    const TemporaryFile config("record.yaml",
                               "server:\n  record_dir: \"" + directory_.string() + "\"\n");
    const PlanRequest box = test::box_request("first");
    auto by_key = dds::write_request(test::box_request("named"), "raw").value();
    by_key.mesh(shape_msgs::msg::dds_::Mesh_());
    by_key.object_key(object_key_of(box.object_O));
    auto bad = dds::write_request(test::box_request("bad"), "raw").value();
    bad.options()[0].friction(-1.0);
    const std::vector<Bytes> sent = {payload_of(dds::write_request(box, "raw").value()),
                                     payload_of(by_key), payload_of(bad)};
    std::vector<Bytes> replies;
    {
        Daemon daemon(domain, {"--config", config.path()});
        test::RawClient raw({}, test::client_settings(domain));
        ASSERT_TRUE(raw.wait_matched());
        for (std::size_t i = 0; i < sent.size(); ++i) {
            ASSERT_TRUE(raw.write(sent[i]));
            replies = raw.wait_for(i + 1);  // one after the other: the key is known by then
            ASSERT_EQ(replies.size(), i + 1);
        }
        daemon.send_signal(SIGTERM);
        EXPECT_EQ(daemon.wait_exit(), 0);
        EXPECT_THAT(daemon.errors(), HasSubstr("event=recorded requests=3 failures=0"));
    }
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const std::string number = "-00000" + std::to_string(i + 1);
        EXPECT_EQ(contents("request" + number + ".cdr"), sent[i]);
        EXPECT_EQ(test::as_received(contents("reply" + number + ".cdr")), replies[i]);
        const auto [code, said] = replay("request" + number + ".cdr");
        EXPECT_EQ(code, 0) << said;
        EXPECT_EQ(said, "the same reply\n");
    }
    EXPECT_TRUE(fs::exists(directory_ / "object-000002.cdr"));
    EXPECT_FALSE(fs::exists(directory_ / "object-000001.cdr"));
}

/// A record of the box made here, so that it can be spoilt.
class ReplayTest : public RecordTest {
protected:
    ReplayTest() {
        fs::create_directories(directory_);
        write("request-000001.cdr", request_payload(box_, "client").value());
        write("reply-000001.cdr", reply_payload(plan(box_, {})));
    }
    void write(const std::string& name, const Bytes& bytes) const {
        std::ofstream(directory_ / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    const PlanRequest box_ = test::box_request("first");
};

TEST_F(ReplayTest, ADifferenceIsNamedAndEndsWithThree) {
    EXPECT_EQ(replay("request-000001.cdr").first, 0);
    PlanReply other = plan(box_, {});
    other.grasps[1].X_FG.translation().x() += 0.001;
    other.grasps.pop_back();
    other.report.findings.push_back({"made_up", 3.0, "by this test"});
    write("reply-000001.cdr", reply_payload(other));
    const auto [code, said] = replay("request-000001.cdr");
    EXPECT_EQ(code, 3);
    EXPECT_THAT(said, HasSubstr("number of grasps\n    recorded: 9\n    replayed: 10\n"));
    EXPECT_THAT(said, HasSubstr("grasp 2: position"));
    EXPECT_THAT(said, HasSubstr("(1 mm)"));
    EXPECT_THAT(said, HasSubstr("finding made_up"));
    EXPECT_THAT(said, testing::Not(HasSubstr("grasp 1:")));
    const auto json = replay("request-000001.cdr", {"--format", "json"});
    EXPECT_EQ(json.first, 3);
    EXPECT_THAT(json.second, HasSubstr("\"same\": false"));
    EXPECT_THAT(json.second, HasSubstr("\"what\": \"number of grasps\""));
}

TEST_F(ReplayTest, OtherSettingsShow) {
    const TemporaryFile config("other.yaml", "search:\n  levels: 1\n  axes_per_round: 2\n");
    EXPECT_EQ(replay("request-000001.cdr", {"--config", config.path()}).first, 3);
}

TEST_F(ReplayTest, WhatCannotBeReadEndsWithTwoAndNamesTheFile) {
    EXPECT_EQ(replay("request-000009.cdr").first, 2);
    write("request-000002.cdr", {0, 1, 0, 0, 9});
    const auto broken = replay("request-000002.cdr");
    EXPECT_EQ(broken.first, 2);
    EXPECT_THAT(broken.second, HasSubstr("request-000002.cdr: 5 bytes are no GraspRequest"));
    write("reply-000001.cdr", {0, 1});
    const auto no_reply = replay("request-000001.cdr");
    EXPECT_EQ(no_reply.first, 2);
    EXPECT_THAT(no_reply.second, HasSubstr("reply-000001.cdr"));
}

}  // namespace
}  // namespace graspd
