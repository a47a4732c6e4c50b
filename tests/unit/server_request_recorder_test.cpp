#include "request_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "server_fakes.hpp"

namespace graspd::server {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// A request that knows its bytes.
struct RecordedRequest : test::FakeRequest {
    std::shared_ptr<const ReceivedPayload> bytes;
    RecordedRequest(const std::string& name, std::vector<std::uint8_t> payload)
        : FakeRequest(3, name),
          bytes(std::make_shared<ReceivedPayload>(ReceivedPayload{std::move(payload), true})) {}
    std::shared_ptr<const ReceivedPayload> payload() const override { return bytes; }
};

class Recorder : public testing::Test {
protected:
    Recorder()
        : directory_(fs::path(testing::TempDir()) / ("records_" + std::to_string(getpid()))) {
        fs::remove_all(directory_);
        settings_.directory = directory_ / "made";
        settings_.version = "1.2.3";
        settings_.config_hash = "abcd";
    }
    ~Recorder() override {
        recorder_.reset();  // its thread tells of failures
        fs::remove_all(directory_);
    }

    void open() {
        auto opened = RequestRecorder::open(
            settings_, {[](const ObjectGeometry&) {
                            return std::vector<std::uint8_t>{7, 7};
                        },
                        [this](const std::string& what, std::uint64_t) {
                            failed_.change([&](auto& list) { list.push_back(what); });
                        }});
        ASSERT_TRUE(opened.ok()) << opened.error().detail;
        recorder_ = std::move(opened).value();
    }
    void record(const std::string& id, std::size_t size = 3) {
        auto request = std::make_shared<RecordedRequest>(
            id, std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(id[0])));
        recorder_->received(*request);
        Answer answer;
        answer.out.to = request;
        recorder_->answered(answer, {1, 2});
    }
    void close() { recorder_.reset(); }

    std::vector<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(settings_.directory)) {
            names.insert(entry.path().filename().string());
        }
        return {names.begin(), names.end()};
    }
    std::string contents(const std::string& name) const {
        std::ifstream stream(settings_.directory / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    fs::path directory_;
    RecorderSettings settings_;
    std::unique_ptr<RequestRecorder> recorder_;
    test::Watched<std::vector<std::string>> failed_;
};

TEST_F(Recorder, WritesRequestsAsTheyCameWithTheirReplies) {
    open();
    record("a");
    record("b");
    close();
    EXPECT_THAT(files(),
                ElementsAre("reply-000001.cdr", "reply-000002.cdr", "request-000001.cdr",
                            "request-000001.json", "request-000002.cdr", "request-000002.json"));
    EXPECT_EQ(contents("request-000002.cdr"), "bbb");
    EXPECT_EQ(contents("reply-000001.cdr"), "\x01\x02");
    const auto note = nlohmann::json::parse(contents("request-000002.json"));
    EXPECT_EQ(note["request_id"], "b");
    EXPECT_EQ(note["number"], 2);
    EXPECT_EQ(note["came_by"], "service");
    EXPECT_EQ(note["writer"], "03000000000000000000000000000000");
    EXPECT_EQ(note["version"], "1.2.3");
    EXPECT_EQ(note["config_hash"], "abcd");
    EXPECT_EQ(note["bytes"], 3);
}

TEST_F(Recorder, KeepsTheObjectThatARequestNames) {
    open();
    auto request = std::make_shared<RecordedRequest>("a", std::vector<std::uint8_t>{1});
    recorder_->received(*request);
    Answer answer;
    answer.out.to = request;
    answer.work.named_object = std::make_shared<ObjectGeometry>(TriangleMesh{});
    recorder_->answered(answer, {1, 2});
    close();
    EXPECT_EQ(contents("object-000001.cdr"), "\x07\x07");
}

TEST_F(Recorder, NumbersGoOnAndTheOldestLeave) {
    settings_.most_requests = 2;
    open();
    for (const char* id : {"a", "b", "c"}) record(id);
    close();
    open();
    record("d");
    close();
    EXPECT_THAT(files(),
                ElementsAre("reply-000003.cdr", "reply-000004.cdr", "request-000003.cdr",
                            "request-000003.json", "request-000004.cdr", "request-000004.json"));
    EXPECT_EQ(contents("request-000004.cdr"), "ddd");
}

// Two notes and 40,000 bytes each fit into 100,000; a third request does not.
TEST_F(Recorder, BytesAreBoundedToo) {
    settings_.most_bytes = 100000;
    open();
    for (const char* id : {"a", "b", "c"}) record(id, 40000);
    close();
    EXPECT_EQ(contents("request-000001.cdr"), "");
    EXPECT_EQ(contents("request-000003.cdr").size(), 40000u);
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(settings_.directory))
        bytes += entry.file_size();
    EXPECT_LE(bytes, 100000u);
}

TEST_F(Recorder, OtherFilesStay) {
    fs::create_directories(settings_.directory);
    std::ofstream(settings_.directory / "request-000007.cdr.bak") << "mine";
    std::ofstream(settings_.directory / "notes.txt") << "mine";
    settings_.most_requests = 1;
    open();
    for (const char* id : {"a", "b"}) record(id);
    close();
    EXPECT_EQ(contents("notes.txt"), "mine");
    EXPECT_EQ(contents("request-000007.cdr.bak"), "mine");
    EXPECT_EQ(contents("request-000002.cdr"), "bbb");
}

// The directory vanishes while graspd runs: requests go on, and each loss is counted.
TEST_F(Recorder, AFailureIsCountedAndSaid) {
    open();
    fs::remove_all(settings_.directory);
    record("a");
    ASSERT_TRUE(failed_.wait([](const auto& list) { return list.size() >= 2; }));
    EXPECT_EQ(recorder_->recorded(), 0u);
    EXPECT_EQ(recorder_->failures(), 2u);
    EXPECT_THAT(failed_.copy()[0], testing::HasSubstr("made"));
}

TEST_F(Recorder, ADirectoryThatCannotBeMadeIsAnError) {
    fs::create_directories(directory_);
    std::ofstream(directory_ / "made") << "a file";
    const auto opened = RequestRecorder::open(settings_, {});
    ASSERT_FALSE(opened.ok());
    EXPECT_THAT(opened.error().detail, testing::HasSubstr("server.record_dir = "));
}

TEST_F(Recorder, ARequestWithoutItsBytesIsNotRecorded) {
    open();
    const auto plain = test::request(1, "plain");
    recorder_->received(*plain);
    close();
    EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace graspd::server
