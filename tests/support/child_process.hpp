#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace graspd::test {

/// A program run by a test: its output is collected while it runs, and it never outlives the test.
class ChildProcess {
public:
    /// Starts it; the test fails when that does not work.
    ChildProcess(const std::string& program, const std::vector<std::string>& arguments);
    /// Kills it if it still runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    void send_signal(int signal) const;
    pid_t id() const { return pid_; }

    /// @return whether standard error came to hold the text within ten seconds
    bool wait_for_error_text(const std::string& text);

    /// Waits for its end, ten seconds at most. @return the exit code, or minus the number of the
    /// signal that ended it; nothing when it still runs
    std::optional<int> wait_exit();

    std::string output() const;  ///< standard output so far
    std::string errors() const;  ///< standard error so far

private:
    void collect(int descriptor, std::string& to);
    void reap();

    pid_t pid_ = -1;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::string output_;
    std::string errors_;
    std::optional<int> exit_;
    std::vector<std::jthread> threads_;
};

}  // namespace graspd::test
