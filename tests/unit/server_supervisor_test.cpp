#include "supervisor.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>

#include "shm_segments.hpp"

namespace graspd::server {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;

constexpr int exited(int code) {
    return W_EXITCODE(code, 0);
}

TEST(Supervisor, JudgesHowTheParticipantEnded) {
    EXPECT_FALSE(judge_exit(exited(0), false).restart);
    EXPECT_EQ(judge_exit(exited(0), false).exit_code, 0);
    EXPECT_FALSE(judge_exit(exited(2), false).restart);  // a bad configuration stays bad
    EXPECT_EQ(judge_exit(exited(2), false).exit_code, 2);
    for (const int crash : {exited(1), exited(127), W_EXITCODE(0, SIGABRT), W_EXITCODE(0, SIGKILL),
                            W_EXITCODE(0, SIGSEGV | WCOREFLAG), W_EXITCODE(0, SIGTERM)}) {
        EXPECT_TRUE(judge_exit(crash, false).restart) << exit_text(crash);
        EXPECT_FALSE(judge_exit(crash, true).restart) << exit_text(crash);
    }
    EXPECT_EQ(judge_exit(exited(0), true).exit_code, 0);
    EXPECT_EQ(judge_exit(exited(1), true).exit_code, 1);
    EXPECT_EQ(judge_exit(W_EXITCODE(0, SIGABRT), true).exit_code, 1);
    EXPECT_EQ(exit_text(W_EXITCODE(0, SIGABRT)), "signal=6");
    EXPECT_EQ(exit_text(exited(1)), "exit_code=1");
}

TEST(Supervisor, WaitsTwiceAsLongAfterEachCrashUntilALifeWasHealthy) {
    const SupervisorConfig config;
    std::vector<milliseconds> waits = {0ms};
    for (int crash = 0; crash < 9; ++crash) {
        waits.push_back(next_wait(waits.back(), 59'999ms, config));
    }
    EXPECT_THAT(waits, testing::ElementsAre(0ms, 100ms, 200ms, 400ms, 800ms, 1600ms, 3200ms, 6400ms,
                                            10000ms, 10000ms));
    EXPECT_EQ(next_wait(10000ms, 60'000ms, config), 100ms);
    EXPECT_EQ(next_wait(0ms, 0ms, {.first_wait_s = 5.0, .longest_wait_s = 2.0}), 2000ms);
}

TEST(Supervisor, TheParticipantGetsItsArgumentsWithoutSupervise) {
    const std::array<const char*, 5> argv = {"graspd", "--domain", "7", "--supervise",
                                             "--ros-args"};
    EXPECT_THAT(participant_arguments(5, argv.data()),
                testing::ElementsAre("graspd", "--domain", "7", "--ros-args"));
}

TEST(Supervisor, RestartsAreReadFromTheEnvironment) {
    const auto read = [](const char* text) {
        ::setenv(kRestartsVariable, text, 1);
        const auto count = restarts_from_environment();
        ::unsetenv(kRestartsVariable);
        return count;
    };
    EXPECT_EQ(restarts_from_environment(), 0u);
    EXPECT_EQ(read("17"), 17u);
    EXPECT_EQ(read("4294967296"), 0u);  // does not fit
    EXPECT_EQ(read("3 times"), 0u);
    EXPECT_EQ(read(""), 0u);
}

/// Files named as Fast DDS names its shared memory.
class ShmSegments : public testing::Test {
protected:
    ShmSegments()
        : folder_(std::filesystem::path(testing::TempDir()) /
                  ("shm_segments_" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~ShmSegments() override {
        for (const int file : open_) ::close(file);
        std::filesystem::remove_all(folder_);
    }
    std::filesystem::path file(const std::string& name, bool locked) {
        const auto path = folder_ / name;
        open_.push_back(::open(path.c_str(), O_CREAT | O_RDONLY | O_CLOEXEC, 0600));
        if (locked && ::flock(open_.back(), LOCK_EX) != 0) ADD_FAILURE() << "no lock on " << name;
        return path;
    }
    void release() {
        for (const int file : open_) ::close(file);
        open_.clear();
    }

private:
    std::filesystem::path folder_;
    std::vector<int> open_;
};

TEST_F(ShmSegments, AProcessOwnsThoseThatItHoldsLocked) {
    const auto own = file("fastrtps_38b250635ee33380_el", true);
    file("fastrtps_0123456789abcdef_el", false);  // somebody else's, looked at
    file("fastrtps_port9160_el", true);           // a port, which the next participant takes over
    file("fastrtps_0123456789abcdef", true);
    file("fastrtps_0123456789abcdeg_el", true);
    EXPECT_THAT(owned_segments(::getpid()), testing::ElementsAre(own));
    release();
    EXPECT_THAT(owned_segments(::getpid()), testing::IsEmpty());
    EXPECT_THAT(owned_segments(::getpid(), "/nowhere"), testing::IsEmpty());
}

TEST_F(ShmSegments, OnlyThoseThatNobodyHoldsAreRemoved) {
    const auto lock = file("fastrtps_38b250635ee33380_el", true);
    const auto segment = file("fastrtps_38b250635ee33380", false);
    const auto port = file("fastrtps_port9160_el", false);
    EXPECT_FALSE(remove_segment(lock));
    EXPECT_TRUE(std::filesystem::exists(lock));
    EXPECT_TRUE(std::filesystem::exists(segment));
    release();
    EXPECT_FALSE(remove_segment(port));
    EXPECT_TRUE(std::filesystem::exists(port));
    EXPECT_TRUE(remove_segment(lock));
    EXPECT_FALSE(std::filesystem::exists(lock));
    EXPECT_FALSE(std::filesystem::exists(segment));
    EXPECT_FALSE(remove_segment(lock));  // gone already
}

}  // namespace
}  // namespace graspd::server
